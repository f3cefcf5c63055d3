// Ambient occlusion: the cosine-weighted part of the sky that is hidden. Channel 0 is the G-buffer.
//
// Method: J. Jimenez, X. Wu, A. Pesce, A. Jarabo, "Practical Realtime Strategies for Accurate Indirect Occlusion",
// SIGGRAPH 2016 courses ("GTAO"): the hemisphere is cut into slices through the line of sight, and in each the
// weighting is integrated in closed form. What hides a slice is kept as 32 sectors of equal weight: O. Therrien, Y.
// Levesque, G. Gilet, "Screen Space Indirect Lighting with Visibility Bitmask", The Visual Computer 39, 2023. So what
// is farther hides less just by the sectors that it hides first, and a thing that stands alone hides no more than its
// thickness.

#iUniform float radius = 0.8 in { 0.05, 4.0 } // how far away something may be to hide the sky, in units of the scene
#iUniform int slices = 2 in { 1, 8 }
#iUniform int steps = 6 in { 2, 16 }          // on either side of a slice

// The sine over a surface's plane below which a point counts as part of it: the rounding of depths to texels would else
// make a plane hide a little of its own sky.
const float BIAS = 0.02;
const float HALF_PI = 1.57079633;

// A slice: the angle from the line of sight to the normal in it, and the weight of the angles on its far side, and of
// all.
struct Slice {
    float normal, low, all;
};

// The cosine-weighted part of a slice between the line of sight and an angle to it (Jimenez et al., section 3).
float weightTo(float angle, float normal) {
    return 0.25 * (cos(normal) + 2.0 * angle * sin(normal) - cos(2.0 * angle - normal));
}

// In which sector a direction is, as a number between 0 and 32; `side` is 1 or -1.
float sectorOf(vec3 towards, vec3 view, float side, Slice s) {
    float angle = side * acos(clamp(dot(towards, view) * inversesqrt(max(dot(towards, towards), 1e-12)), -1.0, 1.0));
    angle = s.normal + clamp(angle - s.normal, -HALF_PI, HALF_PI);
    return 32.0 * (s.low + sign(angle) * weightTo(angle, s.normal)) / s.all;
}

// H. Warren, "Hacker's Delight", 2002, section 5-1.
float bitsIn(uint v) {
    v -= (v >> 1u) & 0x55555555u;
    v = (v & 0x33333333u) + ((v >> 2u) & 0x33333333u);
    return float((((v + (v >> 4u)) & 0x0f0f0f0fu) * 0x01010101u) >> 24u);
}

void mainImage(out vec4 occluded, in vec2 fragCoord) {
    vec2 canvas = iChannelResolution[0].xy;
    ivec2 p = ivec2(fragCoord), size = ivec2(canvas), full = fullTexel(p, iResolution.xy, canvas);
    vec2 pixel = vec2(full) + 0.5;
    vec4 g = texelFetch(iChannel0, full, 0);
    occluded = vec4(0.0, 0.0, 0.0, 1.0);
    if (isNothing(g)) return;
    vec3 at = viewFromPixel(pixel, g.z, canvas), normal = unpackNormal(g.xy), view = normalize(-at);
    // A mesh's normals are means over its faces, and some at the rim of a shape look away from the camera, which sees
    // the surface nevertheless. A slice has no part of the sky on that side.
    normal = normalize(normal - min(dot(normal, view), 0.0) * view);
    float perUnit = FOCAL * unit(canvas) / g.z, pixels = min(radius * perUnit, canvas.y);
    if (pixels < 2.0) return; // the radius is smaller than what a pixel shows

    // 16 directions and 4 distances in a square of 4 x 4 texels, each once: the next pass takes the mean over them all.
    int turn = (p.x & 3) * 4 + ((p.y * 5 + (p.x & 3)) & 3), step_ = (p.x + 2 * p.y) & 3;
    // Two directions at right angles to the line of sight: slices are to be spread evenly around it, and not around the
    // camera's axis, or a plane at the picture's edge would not come out fully open.
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), view)), up = cross(view, right);
    float hidden = 0.0;
    for (int i = 0; i < slices; i++) {
        float phi = 2.0 * HALF_PI * (float(i) + (float(turn) + 0.5) / 16.0) / float(slices);
        vec3 ahead = cos(phi) * right + sin(phi) * up, across = cross(ahead, view);
        vec2 along = normalize(at.xy * ahead.z - at.z * ahead.xy); // the slice, as a line in the picture
        vec3 inSlice = normal - across * dot(normal, across); // the normal as this slice sees it
        float share = length(inSlice);
        Slice s;
        s.normal = sign(dot(ahead, inSlice)) * acos(clamp(dot(inSlice, view) / max(share, 1e-5), -1.0, 1.0));
        s.low = weightTo(s.normal - HALF_PI, s.normal);
        s.all = s.low + weightTo(s.normal + HALF_PI, s.normal);
        uint mask = 0u;
        float part = 0.0;
        for (int side = -1; side <= 1; side += 2) {
            float edge = side > 0 ? 32.0 : 0.0, before = 0.0, last = 0.0;
            vec3 previous = vec3(0.0);
            for (int j = 0; j < steps; j++) {
                float t = (float(j) + (float(step_) + 0.5) / 4.0) / float(steps),
                    far = max(t * t * pixels, float(j) + 1.0);
                ivec2 q = ivec2(floor(pixel + float(side) * along * far));
                if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, size))) break;
                vec3 delta = viewFromPixel(vec2(q) + 0.5, texelFetch(iChannel0, q, 0).z, canvas) - at;
                // A surface that goes on from the last place to this one hides all that is between them, and about half
                // way; what comes after a gap hides what is before and within it, and there.
                bool goesOn = length(delta - previous) < 4.0 * (far - last) / perUnit + 0.01;
                float away = length(delta), here = sectorOf(delta, view, float(side), s);
                // What comes after a gap and stands nearer to the camera hides with its back, which is nearer than its
                // front. How much nearer the G-buffer does not know: 0.15 of the thickness, more lets things hide the
                // open table.
                float back = 0.15 * clamp(dot(delta, view), 0.0, thickness);
                float where = goesOn ? 0.5 * (away + before) : length(delta - back * view), other = edge;
                previous = delta;
                before = away;
                edge = here;
                last = far;
                if (dot(delta, normal) < BIAS * away) continue;
                float behind = sectorOf(delta - thickness * view, view, float(side), s);
                if (!goesOn) other = behind;
                else other = side > 0 ? max(other, behind) : min(other, behind);
                int from = int(floor(min(here, other) + 0.5)), to = int(floor(max(here, other) + 0.5));
                if (to <= from) continue;
                uint sectors = (to - from > 31 ? 0xffffffffu : (1u << uint(to - from)) - 1u) << uint(from);
                part += clamp((radius - where) / (0.4 * radius), 0.0, 1.0) * bitsIn(sectors & ~mask);
                mask |= sectors;
            }
        }
        hidden += share * s.all * part / 32.0;
    }
    occluded.r = hidden / float(slices);
}
