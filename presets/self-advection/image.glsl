// The paint as a lacquered relief: the direction of the vector gives the hue, its length the thickness.
// Channel 0 is the paint, repeating.

vec4 paintOf(ivec2 p) {
    return texelFetch(iChannel0, ivec2(mod(vec2(p), iResolution.xy)), 0);
}

// Around the wheel of directions through five lacquers.
vec3 lacquer(vec2 v, float second) {
    float a = atan(v.y, v.x);
    vec3 ring = 0.5 + 0.5 * cos(a + vec3(0.0, 0.75, 1.7));
    vec3 other = 0.5 + 0.5 * cos(2.4 * second + vec3(2.6, 3.9, 5.2));
    return mix(vec3(0.90, 0.86, 0.76), mix(ring * ring, other, 0.35), smoothstep(0.05, 0.40, length(v)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y, slope = vec2(0.0);
    float scale = iResolution.y / 270.0;
    // Colours are averaged, and not the vectors: on a front between two opposite ones those would cancel, and leave a
    // pale rim.
    vec3 shown = vec3(0.0);
    for (int y = -1; y <= 1; y++) {
        for (int x = -1; x <= 1; x++) {
            vec4 q = paintOf(p + ivec2(x, y));
            shown += float((2 - abs(x)) * (2 - abs(y))) / 16.0 * lacquer(q.xy, q.w);
            float height = 0.6 * smoothstep(0.0, 1.0, length(q.xy)) + 0.3 * q.z;
            slope -= height * vec2(x * (2 - abs(y)), y * (2 - abs(x))) / 4.0; // I. Sobel, G. Feldman 1968
        }
    }
    slope *= scale;
    slope /= 1.0 + 1.5 * length(slope); // a front is steep, but no cliff
    vec3 n = normalize(vec3(1.5 * slope, 1.0));
    vec3 sun = normalize(vec3(-0.5, 0.7, 0.9)), eye = normalize(vec3(-0.3 * uv, 1.0)), half_ = normalize(sun + eye);
    shown *= 0.30 + 0.86 * max(dot(n, sun), 0.0);
    float fresnel = 0.04 + 0.5 * pow(1.0 - clamp(dot(n, eye), 0.0, 1.0), 3.0);
    shown += fresnel * vec3(0.55, 0.60, 0.70) + 0.30 * pow(max(dot(n, half_), 0.0), 70.0);
    fragColor = vec4(pow(max(shown, 0.0), vec3(0.85)) * (1.0 - 0.3 * min(dot(uv, uv), 1.0)), 1.0);
}
