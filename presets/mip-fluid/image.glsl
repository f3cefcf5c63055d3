// Marbled paper, glazed. Channel 0: the paint.

vec4 paintOf(ivec2 p) {
    return texelFetch(iChannel0, ivec2(mod(vec2(p), iResolution.xy)), 0);
}

float height(ivec2 p) {
    vec3 q = paintOf(p).xyz;
    return dot(q, vec3(0.55, 0.35, 0.25));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float scale = iResolution.y / 270.0;
    vec4 q = paintOf(p);
    vec2 slope = vec2(height(p - ivec2(1, 0)) - height(p + ivec2(1, 0)),
                      height(p - ivec2(0, 1)) - height(p + ivec2(0, 1)));
    vec3 n = normalize(vec3(1.3 * scale * slope, 1.0));
    vec3 sun = normalize(vec3(-0.5, 0.7, 0.8)), eye = normalize(vec3(-0.3 * uv, 1.0));

    vec3 shown = mix(vec3(0.045, 0.075, 0.17), vec3(0.78, 0.60, 0.30), q.y);
    shown = mix(shown, vec3(0.94, 0.91, 0.83), q.x * (1.0 - 0.55 * q.y));
    shown = mix(shown, vec3(0.58, 0.10, 0.09), 0.75 * q.z * (1.0 - q.x));
    shown *= 0.45 + 0.65 * max(dot(n, sun), 0.0) + 0.12 * smoothstep(0.0, 0.5, q.w);
    shown += 0.30 * pow(max(dot(n, normalize(sun + eye)), 0.0), 45.0);
    fragColor = vec4(pow(max(shown, 0.0), vec3(0.8)) * (1.0 - 0.3 * min(dot(uv, uv), 1.0)), 1.0);
}
