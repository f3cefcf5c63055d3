// The paint as a lacquered relief: the direction of the vector gives the hue, its length the thickness.
// Channel 0 is the paint, repeating.

vec4 paintOf(ivec2 p) {
    return texelFetch(iChannel0, ivec2(mod(vec2(p), iResolution.xy)), 0);
}

float height(ivec2 p) {
    vec4 q = paintOf(p);
    return 0.6 * length(q.xy) + 0.25 * q.z;
}

// Around the wheel of directions through five lacquers.
vec3 lacquer(vec2 v, float second) {
    float a = atan(v.y, v.x);
    vec3 ring = 0.5 + 0.5 * cos(a + vec3(0.0, 0.75, 1.7));
    vec3 other = 0.5 + 0.5 * cos(2.4 * second + vec3(2.6, 3.9, 5.2));
    return mix(vec3(0.93, 0.90, 0.82), mix(ring * ring, other, 0.35), smoothstep(0.0, 0.7, length(v)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float scale = iResolution.y / 270.0;
    vec4 q = paintOf(p);
    vec2 slope = vec2(height(p - ivec2(1, 0)) - height(p + ivec2(1, 0)), height(p - ivec2(0, 1)) - height(p + ivec2(0, 1)));
    vec3 n = normalize(vec3(1.6 * scale * slope, 1.0));
    vec3 sun = normalize(vec3(-0.5, 0.7, 0.8)), eye = normalize(vec3(-0.3 * uv, 1.0));

    vec3 shown = lacquer(q.xy, q.w);
    shown *= 0.35 + 0.80 * max(dot(n, sun), 0.0);
    shown += 0.45 * pow(max(dot(n, normalize(sun + eye)), 0.0), 50.0);
    fragColor = vec4(pow(max(shown, 0.0), vec3(0.85)) * (1.0 - 0.3 * min(dot(uv, uv), 1.0)), 1.0);
}
