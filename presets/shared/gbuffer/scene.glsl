// A still life on a table, by sphere tracing: J. Hart, "Sphere Tracing", The Visual Computer 12, 1996. The distance
// functions of its parts are exact; a ray is only marched inside of the box that holds all things.

#iUniform float turning = 0.3 in { -2.0, 2.0 } // radians a second that the camera goes round

const int TABLE = 1, MUG = 2, DIE = 3, BALL = 4, RING = 5;
const vec3 BOX_LOW = vec3(-1.75, 0.0, -1.15), BOX_HIGH = vec3(1.45, 1.25, 1.45);
const vec3 SUN = vec3(0.42, 0.78, 0.46);

float cylinder(vec3 p, float radius, float half_) {
    vec2 q = vec2(length(p.xz) - radius, abs(p.y) - half_);
    return min(max(q.x, q.y), 0.0) + length(max(q, 0.0));
}

float torus(vec2 inPlane, float across, float radius, float tube) {
    return length(vec2(length(inPlane) - radius, across)) - tube;
}

// Distance and material of the nearest thing on the table.
vec2 things(vec3 p) {
    vec3 q = p - vec3(-0.80, 0.56, -0.25);
    float mug = max(cylinder(q, 0.46, 0.52), -cylinder(q - vec3(0.0, 0.12, 0.0), 0.39, 0.52)) - 0.03;
    mug = min(mug, max(torus(q.xy + vec2(0.50, 0.0), q.z, 0.27, 0.07), length(q.xz) > 0.44 ? -1.0 : 1.0));
    vec3 b = p - vec3(0.78, 0.40, -0.38);
    b.xz = vec2(0.84 * b.x + 0.54 * b.z, -0.54 * b.x + 0.84 * b.z);
    vec3 r = abs(b) - 0.37;
    float die = length(max(r, 0.0)) + min(max(r.x, max(r.y, r.z)), 0.0) - 0.02;
    float ball = length(p - vec3(0.05, 0.36, 0.62)) - 0.36;
    float ring = torus(p.xz - vec2(0.92, 0.78), p.y - 0.11, 0.30, 0.11);
    vec2 nearest = vec2(mug, MUG);
    if (die < nearest.x) nearest = vec2(die, DIE);
    if (ball < nearest.x) nearest = vec2(ball, BALL);
    if (ring < nearest.x) nearest = vec2(ring, RING);
    return nearest;
}

// Where along a ray it is inside of the box: from, to; from > to if never.
vec2 insideBox(vec3 from, vec3 d) {
    vec3 a = (BOX_LOW - from) / d, b = (BOX_HIGH - from) / d;
    vec3 low = min(a, b), high = max(a, b);
    return vec2(max(max(low.x, low.y), max(low.z, 0.0)), min(high.x, min(high.y, high.z)));
}

// Distance to the first thing, or -1. `what` is its material.
float march(vec3 from, vec3 d, float until, float near, out int what) {
    vec2 inside = insideBox(from, d);
    float t = max(inside.x, near), end = min(inside.y, until);
    what = 0;
    for (int i = 0; i < 56 && t < end; i++) {
        vec2 q = things(from + t * d);
        if (q.x < 4e-4 * t) {
            what = int(q.y);
            return t;
        }
        t += q.x;
    }
    return -1.0;
}

vec3 normalAt(vec3 p) { // four corners of a tetrahedron instead of six differences
    const vec2 H = vec2(1.0, -1.0) * 1e-3;
    return normalize(H.xyy * things(p + H.xyy).x + H.yyx * things(p + H.yyx).x
                   + H.yxy * things(p + H.yxy).x + H.xxx * things(p + H.xxx).x);
}

// How much of the sun arrives; the penumbra is as wide as the thing that throws it is far.
float sunlight(vec3 p) {
    vec2 inside = insideBox(p, SUN);
    float t = max(inside.x, 0.02), light = 1.0;
    for (int i = 0; i < 20 && t < inside.y; i++) {
        float d = things(p + t * SUN).x;
        light = min(light, 10.0 * d / t);
        if (light < 0.01) return 0.0;
        t += max(d, 0.03);
    }
    return light;
}

void camera(vec4 mouse, vec2 resolution, float time, out vec3 from, out mat3 axes) {
    vec2 hand = abs(mouse.x) + abs(mouse.y) > 0.0 ? mouse.xy / resolution - 0.5 : vec2(0.0);
    float angle = 0.45 * sin(turning * time) + 0.35 + 5.0 * hand.x, pitch = 0.46 + 0.7 * clamp(hand.y, -0.45, 0.45);
    vec3 back = vec3(sin(angle) * cos(pitch), sin(pitch), cos(angle) * cos(pitch));
    vec3 right = normalize(cross(vec3(0.0, 1.0, 0.0), back));
    axes = mat3(right, cross(back, right), back);
    from = vec3(0.0, 0.42, 0.05) + 5.2 * back;
}

// The G-buffer's texel for a pixel.
vec4 surface(vec2 pixel, vec2 resolution, vec4 mouse, float time) {
    vec3 from;
    mat3 axes;
    camera(mouse, resolution, time, from, axes);
    vec3 d = normalize(axes * viewFromPixel(pixel, 1.0, resolution));
    float table = d.y < 0.0 ? -from.y / d.y : FAR;
    if (length((from + table * d).xz) > 14.0) table = FAR;
    int what;
    float t = march(from, d, table, 0.0, what);
    if (t < 0.0 && table >= FAR) return vec4(packNormal(vec3(0.0, 0.0, 1.0)), FAR, 0.999);
    vec3 p, n;
    if (t < 0.0) {
        t = table;
        what = TABLE;
        n = vec3(0.0, 1.0, 0.0);
        p = from + t * d;
    } else {
        p = from + t * d;
        n = normalAt(p);
    }
    float facing = max(dot(n, SUN), 0.0);
    float light = 0.16 + 0.10 * n.y + 0.72 * facing * (facing > 0.0 ? sunlight(p + 0.01 * n) : 0.0);
    return vec4(packNormal(n * axes), dot(p - from, -axes[2]), float(what) + clamp(light, 0.0, 0.999));
}
