// Rotational self-advection on many scales, a flow without a fluid.
//
// The paint's first two components are read as a vector field, V = paint.xy. On a ring of five points around a place q
// the mean of V along the ring, divided by its radius, is the angular velocity of an eddy of that size:
//
//     turning(q, r) = 1/5 sum_i V(q + r e_i) . perp(e_i) / r
//
// An odd number of points, so that no two face each other and five looks see what ten would. Such an eddy, were it a
// wheel, would carry a point on its rim along at turning * perp(point - q). The flow at p is what the wheels do whose
// rims p is on: five around it, on every ring size from two pixels on, each `growth` times the one before. Then the
// flow carries the paint, its vectors included. A uniform V turns nothing (the e_i sum to zero), and of a rigid
// rotation every wheel turns alike, so that the five cancel: only differences in rotation move anything. It is
// circulation (Stokes) measured coarsely, in the spirit of vortex methods: G.-H. Cottet, P. Koumoutsakos, "Vortex
// Methods", Cambridge 2000.

// Sizes of rings. Each costs 25 looks a pixel of the flow, unless its radius has left REACH heights: then this and all
// larger ones are passed over, as a ring that large sees mostly the other side of the picture.
#iUniform int scales = 20 in { 0, 20 }
#iUniform float growth = 2.0 in { 1.25, 3.0 }
// Pixels a frame on a canvas 270 pixels high, where V is 1 along the rims of one size. No step is too long: paint stays
// in the range of the four texels it comes from. From about 10 on it leaps over the eddies that move it, and its edges
// fray.
#iUniform float strength = 1.2 in { 0.0, 50.0 }
// What weight a ring size has over the one before: above 1 large eddies rule, below it small ones.
#iUniform float slope = 1.35 in { 0.5, 2.0 }
// Vectors grow by this in a second, up to length 1; without it, blur would put everything to rest.
#iUniform float vigour = 0.25 in { 0.0, 3.0 }
#iUniform float wheels = 1.0 in { 0.0, 1.0 }
#iUniform float brush_size = 0.06 in { 0.01, 0.3 }

const int ROT_NUM = 5;
const int MAX_SCALES = 20;
const float REACH = 0.7; // canvas heights

vec2 perp(vec2 v) {
    return vec2(-v.y, v.x);
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// Three numbers in 0..1 for a lattice point: T. Jarzynski and M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3),
// 2020 (their pcg3d).
vec3 hash(ivec3 lattice) {
    uvec3 v = uvec3(lattice) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

float segmentDistance(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-6), 0.0, 1.0));
}
