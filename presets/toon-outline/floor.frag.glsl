// A round floor with the meshes' shadows on it, as flat as they.

#include "light.glsl"

in vec3 vWorld;
out vec4 colour;

float shadow(vec2 p, vec2 at, float radius, float height) {
    vec3 light = toLight();
    vec2 fall = -light.xz / max(light.y, 0.2) * height, q = p - at;
    // The distance from the way that a ball's shadow goes from the ground to its height.
    float t = clamp(dot(q, fall) / max(dot(fall, fall), 1e-6), 0.0, 1.0);
    return step(length(q - t * fall), radius);
}

void main() {
    vec2 p = vWorld.xz;
    float far = length(p);
    if (far > 3.55) discard;
    float dark = max(shadow(p, vec2(0.0, 0.5), 0.72, 1.5),
                     max(shadow(p, vec2(-2.0, -0.6), 0.86, 0.9), shadow(p, vec2(2.05, -0.9), 0.72, 1.2)));
    vec3 plain = far > 3.42 ? vec3(0.93, 0.36, 0.28) : vec3(0.98, 0.86, 0.62);
    colour = vec4(plain * mix(vec3(1.0), vec3(0.72, 0.62, 0.74), dark), 1.0);
}
