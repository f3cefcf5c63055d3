// Three inks in clear water over dark slate. Each has a colour it lets through and one it scatters; the folds are lit
// as if thickness were height. Channel 0 is the dye, channel 1 the pace.

vec3 dyeOf(ivec2 p) {
    return texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1), 0).rgb;
}

float height(ivec2 p) {
    vec3 q = dyeOf(p);
    return 1.0 - exp(-1.5 * (q.r + q.g + q.b));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float scale = iResolution.y / 270.0;
    vec3 dye = max(dyeOf(p), 0.0);
    vec2 slope = vec2(height(p - ivec2(1, 0)) - height(p + ivec2(1, 0)),
                      height(p - ivec2(0, 1)) - height(p + ivec2(0, 1)));
    vec3 n = normalize(vec3(2.4 * scale * slope, 1.0));
    vec3 sun = normalize(vec3(-0.6, 0.6, 0.7)), eye = normalize(vec3(-0.4 * uv, 1.0));

    vec3 ink = mat3(1.00, 0.30, 0.10, /**/ 0.06, 0.52, 0.55, /**/ 0.95, 0.80, 0.55)
        * (dye / (dye.r + dye.g + dye.b + 0.05));
    float thick = height(p);
    vec3 slate = mix(vec3(0.060, 0.068, 0.085), vec3(0.018, 0.020, 0.030), min(length(uv), 1.0));
    vec3 shown = mix(slate, ink, thick);
    shown *= 0.40 + 0.75 * max(dot(n, sun), 0.0);
    shown += 0.25 * thick * pow(max(dot(n, normalize(sun + eye)), 0.0), 40.0);
    shown = pow(max(shown, 0.0), vec3(1.0 / 1.7));
    if (paceIn(iChannel1) < 0.9 && fragCoord.y < 0.03 * iResolution.y
        && mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y) {
        shown = vec3(0.85, 0.1, 0.1); // slower than the slider says
    }
    fragColor = vec4(shown, 1.0);
}
