// The G-buffer: what a picture needs to know of the nearest surface, four numbers a texel.
//
//   x, y   the normal, seen from the camera (z points at it), as a Lambert azimuthal map: the whole sphere but one
//   point,
//          and nothing is lost at a silhouette, where the z of a plain normal.xy would be the root of almost nothing.
//          (M. Mittring, "A Bit More Deferred - CryEngine 3", 2009)
//   z      depth: how far in front of the camera's plane, in units of the scene; FAR where there is nothing
//   w      material + diffuse: a whole number, and as its fraction how bright the diffuse light is, 0 to 0.999

const float FAR = 100.0;
const float FOCAL = 1.8; // in units of a picture

// Pixels in a unit: the height, or less where the canvas is too narrow for the scene.
float unit(vec2 resolution) {
    return min(resolution.y, 0.8 * resolution.x);
}

vec2 packNormal(vec3 n) {
    return n.xy * inversesqrt(max(8.0 * n.z + 8.0, 1e-6));
}

vec3 unpackNormal(vec2 e) {
    e *= 4.0;
    float f = min(dot(e, e), 4.0);
    return vec3(e * sqrt(1.0 - 0.25 * f), 1.0 - 0.5 * f);
}

// A pixel and its depth to a point as the camera sees it (x right, y up, z towards the camera, so -depth), and back.
vec3 viewFromPixel(vec2 pixel, float depth, vec2 resolution) {
    return depth * vec3((pixel - 0.5 * resolution) / (unit(resolution) * FOCAL), -1.0);
}

vec2 pixelFromView(vec3 p, vec2 resolution) {
    return 0.5 * resolution + unit(resolution) * FOCAL * p.xy / max(-p.z, 1e-4);
}
