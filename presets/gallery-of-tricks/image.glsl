// Eight panels: what breaks above, what works below. Channel 0 discard, 1 region, 2 waves (and in its z the
// pattern), 3 progress.

vec3 ramp(float t, vec3 low, vec3 middle, vec3 high) {
    return t < 0.5 ? mix(low, middle, smoothstep(0.0, 0.5, t)) : mix(middle, high, smoothstep(0.5, 1.0, t));
}

// The half of a buffer that a panel shows.
vec2 part(vec2 uv, bool works) {
    return vec2(0.5 * uv.x + (works ? 0.5 : 0.0), uv.y);
}

vec3 data(vec2 uv, bool works, float pixel) {
    if (!works) {
        ivec2 size = textureSize(iChannel0, 0);
        vec2 at = texture(iChannel0, vec2(0.5 * uv.x, max(uv.y, 1.5 / float(size.y)))).xy;
        return vec3(0.05, 0.05, 0.07) + at.x * vec3(0.85, 0.20, 0.10) + at.y * vec3(0.35, 0.10, 0.05);
    }
    vec2 kept = texture(iChannel0, vec2(0.5 + 0.5 * uv.x, max(uv.y, 0.04))).xy;
    vec3 light = vec3(0.035, 0.050, 0.060) + kept.x * vec3(0.02, 0.09, 0.09);
    for (int i = 0; i < BALLS; i++) { // a disc by the region's state, a ring by the discard's: they lie on each other
        vec2 disc = texelFetch(iChannel1, ivec2(i, 0), 0).xy, ring = texelFetch(iChannel0, ivec2(i, 0), 0).xy;
        vec3 own = 0.5 + 0.45 * cos(6.2832 * (float(i) / float(BALLS) * 0.35 + 0.45 + vec3(0.0, 0.33, 0.67)));
        light = mix(light, own, clamp((0.036 - length(uv - disc)) / pixel + 0.5, 0.0, 1.0));
        light += 0.5 * clamp(1.0 - abs(length(uv - ring) - 0.042) / pixel, 0.0, 1.0);
    }
    return light;
}

vec3 water(vec2 uv, bool works) {
    vec2 size = vec2(textureSize(iChannel2, 0)), step_ = 1.0 / size;
    vec2 inside = clamp(uv, vec2(3.0, 1.5) * step_, 1.0 - vec2(3.0, 1.5) * step_), at = part(inside, works);
    float h = texture(iChannel2, at).x;
    vec2 slope = vec2(texture(iChannel2, at + vec2(step_.x, 0.0)).x - texture(iChannel2, at - vec2(step_.x, 0.0)).x,
                      texture(iChannel2, at + vec2(0.0, step_.y)).x - texture(iChannel2, at - vec2(0.0, step_.y)).x);
    vec3 n = normalize(vec3(-14.0 * slope, 1.0));
    vec3 deep = ramp(clamp(0.5 + 2.5 * h, 0.0, 1.0), vec3(0.010, 0.035, 0.075), vec3(0.020, 0.100, 0.150), vec3(0.10, 0.32, 0.36));
    return deep + 0.5 * pow(max(dot(n, normalize(vec3(-0.4, 0.5, 1.1))), 0.0), 40.0) * vec3(0.8, 0.95, 1.0);
}

vec3 sky(vec2 uv, bool works) {
    vec2 size = vec2(textureSize(iChannel3, 0));
    vec4 q = texture(iChannel3, part(clamp(uv, 1.0 / size, 1.0 - 1.0 / size), works));
    float cover = smoothstep(0.46, 0.72, q.x);
    vec3 blue = mix(vec3(0.16, 0.36, 0.62), vec3(0.05, 0.15, 0.38), uv.y);
    return mix(vec3(0.006), mix(blue, vec3(0.92, 0.90, 0.88) * (0.65 + 0.5 * q.x), cover), clamp(q.w / 8.0, 0.0, 1.0));
}

vec3 pattern(vec2 uv, bool works) {
    vec2 size = vec2(textureSize(iChannel2, 0));
    float h = texture(iChannel2, part(clamp(uv, 1.0 / size, 1.0 - 1.0 / size), works)).z;
    return ramp(0.5 + 0.62 * h, vec3(0.17, 0.03, 0.13), vec3(0.50, 0.20, 0.16), vec3(0.98, 0.78, 0.42));
}

// A tick or a cross, its middle at 0.
float mark(vec2 p, bool works, float pixel) {
    vec2 a = works ? vec2(-0.5, 0.0) : vec2(-0.4, -0.4), b = works ? vec2(-0.15, -0.4) : vec2(0.4, 0.4);
    vec2 c = works ? vec2(0.5, 0.45) : vec2(-0.4, 0.4), e = works ? b : vec2(0.4, -0.4);
    vec2 u = b - a, v = e - c;
    float first = length(p - a - u * clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0));
    float second = length(p - c - v * clamp(dot(p - c, v) / dot(v, v), 0.0, 1.0));
    return clamp((0.11 - min(first, second)) / pixel + 0.5, 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 panels = fragCoord / iResolution.xy * vec2(4.0, 2.0);
    ivec2 which = ivec2(panels);
    bool works = which.y == 0;
    vec2 size = iResolution.xy / vec2(4.0, 2.0), p = (fract(panels) - 0.5) * size;
    float gap = max(0.012 * iResolution.y, 0.5);
    vec2 inner = max(size - 2.0 * gap, 1.0), uv = clamp(p / inner + 0.5, 0.0, 1.0);
    vec3 light = which.x == 0 ? data(uv, works, 1.0 / inner.y) : which.x == 1 ? water(uv, works)
               : which.x == 2 ? sky(uv, works) : pattern(uv, works);
    float corner = 0.10 * min(size.x, size.y);
    vec2 q = (p - 0.5 * inner + 0.9 * corner) / (0.55 * corner);
    vec3 sign_ = works ? vec3(0.45, 0.95, 0.50) : vec3(1.00, 0.32, 0.28);
    light = mix(light, vec3(0.01), clamp((1.05 - length(q)) * 0.55 * corner + 0.5, 0.0, 1.0) * 0.8);
    light = mix(light, sign_, mark(q, works, 1.0 / max(0.55 * corner, 1.0)));
    vec2 out_ = abs(p) - 0.5 * inner;
    light = mix(light, vec3(0.012, 0.013, 0.018), clamp(max(out_.x, out_.y) + 0.5, 0.0, 1.0));
    fragColor = vec4(sqrt(max(light, 0.0)), 1.0);
}
