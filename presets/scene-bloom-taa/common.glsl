// A whole picture, from the light to the film: scene -> temporal anti-aliasing -> bloom -> lens -> tone curve.
//
//   A            one jittered sample a pixel, linear light, and the distance of what was hit
//   B            the history, reprojected by that distance and the camera of the frame before
//   C            the distances and the time of the frame before
//   down1..4     the history halved four times; up3..1 put together again: the bloom
//   Image        chromatic aberration and vignette of a simple lens, exposure, tone curve, grain
//
// The order matters. Anti-aliasing before the bloom: a light between two pixels would make the whole glow blink. Both
// before the tone curve: light adds up, colours of a screen do not. The lens bends what the film then records.

#iUniform float orbit = 0.25 in { -1.0, 1.0 }   // how fast the camera goes round, radians in 2 seconds
#iUniform float lamps = 14.0 in { 0.0, 60.0 }   // radiance of the lamps

struct Camera {
    vec3 from, right, up, ahead;
};

const float FOCAL = 1.55; // in units of a picture

// Pixels in a unit: the height, or less where the canvas is too narrow for the scene.
float unit(vec2 resolution) {
    return min(resolution.y, 0.7 * resolution.x);
}

// The mouse turns the camera while it is held, and leaves it there.
Camera camera(float time, vec4 mouse, vec2 resolution) {
    vec2 hand = abs(mouse.x) + abs(mouse.y) > 0.0 ? mouse.xy / resolution - 0.5 : vec2(0.0);
    float angle = 0.5 * orbit * time + 0.6 + 6.0 * hand.x, height = 1.35 + 1.6 * clamp(hand.y, -0.5, 0.5);
    Camera c;
    c.from = vec3(5.2 * sin(angle), height, 5.2 * cos(angle));
    c.ahead = normalize(vec3(0.0, 0.62, 0.0) - c.from);
    c.right = normalize(cross(c.ahead, vec3(0.0, 1.0, 0.0)));
    c.up = cross(c.right, c.ahead);
    return c;
}

// Pixels to a direction (not of length 1: one unit ahead), and a point back to pixels.
vec3 rayThrough(Camera c, vec2 pixel, vec2 resolution) {
    vec2 q = (pixel - 0.5 * resolution) / unit(resolution);
    return FOCAL * c.ahead + q.x * c.right + q.y * c.up;
}

vec2 pixelOf(Camera c, vec3 p, vec2 resolution) {
    vec3 q = p - c.from;
    float z = max(dot(q, c.ahead), 1e-3);
    return 0.5 * resolution + unit(resolution) * FOCAL / z * vec2(dot(q, c.right), dot(q, c.up));
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// Eight points of the Halton sequence in bases 2 and 3, from -0.5 to 0.5.
const vec2 HALTON[8] = vec2[8](vec2(0.0, -1.0 / 6.0), vec2(-0.25, 1.0 / 6.0), vec2(0.25, -7.0 / 18.0),
                               vec2(-0.375, -1.0 / 18.0), vec2(0.125, 5.0 / 18.0), vec2(-0.125, -5.0 / 18.0),
                               vec2(0.375, 1.0 / 18.0), vec2(-0.4375, 7.0 / 18.0));

vec2 jitter(int frame) {
    return HALTON[frame % 8];
}
