#include "lobe.glsl"

// Normals about the eye's direction, up to 50 degrees away.
vec3 normalAt(vec2 at, vec3 eye) {
    vec3 side = normalize(cross(eye, vec3(0.0, 1.0, 0.0)));
    return normalize(eye + 1.2 * (at.x * side + at.y * cross(side, eye)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    // Nothing moves, and yet every frame is drawn, so that it can be timed. The cubemap rests.
    float still = float(iFrame / 1000000);
    vec3 eye = normalize(vec3(0.3, 0.4, 0.85) + still), normal = normalAt(fragCoord / iResolution.xy * 2.0 - 1.0, eye);
    vec3 side = normalize(cross(normal, vec3(0.0, 1.0, 0.0)));
    mat3 frame = mat3(side, cross(normal, side), normal);
    float texel = 4.0 * PI / (6.0 * SIDE * SIDE), sum = 0.0, weights = 0.0;
    int count = METHOD == MIRROR ? 1 : samples;
    for (int i = 0; i < count; i++) {
        vec3 h = frame * (METHOD == MIRROR ? vec3(0.0, 0.0, 1.0) : halfVector(hammersley(i, count), alpha));
        vec3 light = reflect(-eye, h);
        float cosine = dot(normal, light);
        if (cosine <= 0.0) continue;
        float cosH = max(dot(normal, h), 1e-4), cosE = max(dot(eye, h), 1e-4);
        float density = ggx(cosH, alpha) * cosH / (4.0 * cosE);
        float level = METHOD == PLAIN ? 0.0 : max(0.5 * log2(1.0 / (float(count) * density * texel)) + 1.0, 0.0);
        sum += cosine * textureLod(iChannel0, light, level).x;
        weights += cosine;
    }
    fragColor = vec4(sum / max(weights, 1e-4));
}
