// The light that each texel sends, its reflection left out. Channel 0 is the G-buffer, channel 1 the ambient occlusion.

#include "scene.glsl"

#iUniform float occlusion = 1.0 in { 0.0, 2.0 }
#iUniform bool ambientOnly = true                  // false: what is hidden from the sky loses some of the sun, too
#iUniform float shininess = 70.0 in { 1.0, 400.0 } // the exponent of the highlights
#iUniform bool blinn = true                        // false: Phong's highlights, narrower for the same exponent

vec3 paint(int material) {
    return material == 2 ? vec3(0.020, 0.215, 0.265) : material == 3 ? vec3(0.830, 0.400, 0.035)
         : material == 4 ? vec3(0.640, 0.040, 0.030) : vec3(0.780, 0.740, 0.660);
}

// A number in 0..1 for a cell, of integers alone and so the same on every GPU: pcg2d (M. Jarzynski, M. Olano, "Hash
// Functions for GPU Rendering", JCGT 9(3), 2020).
float hash(ivec2 cell) {
    uvec2 v = uvec2(cell) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return float(v.x >> 8u) / 16777216.0;
}

float noise(vec2 p) {
    vec2 base = floor(p), f = p - base;
    ivec2 i = ivec2(base);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + ivec2(1, 0)), f.x), mix(hash(i + ivec2(0, 1)), hash(i + 1), f.x), f.y);
}

// Boards of walnut. What is finer than a pixel, `blur` wide, is left out.
vec3 walnut(vec2 p, float blur) {
    p = vec2(0.94 * p.x + 0.34 * p.y, 0.94 * p.y - 0.34 * p.x);
    float board = floor(p.y / 0.62), across = p.y / 0.62 - board, own = hash(ivec2(board, 3));
    vec2 q = vec2(0.55 * p.x + 17.0 * own, p.y + 5.0 * own);
    float rings = sin(22.0 * (q.y + 0.35 * noise(q * vec2(0.9, 1.6))) + 5.0 * noise(q * vec2(0.5, 3.0)));
    float fibre = noise(q * vec2(7.0, 130.0));
    float grain = 0.5 + 0.32 * rings * exp(-60.0 * blur) + 0.36 * (fibre - 0.5) * exp(-300.0 * blur);
    vec3 wood = mix(vec3(0.022, 0.010, 0.006), vec3(0.098, 0.044, 0.021), grain) * (0.75 + 0.5 * own);
    return wood * mix(1.0, smoothstep(0.0, 0.012 + blur, min(across, 1.0 - across)), 0.75 * exp(-40.0 * blur));
}

// What a direction brings from the room: dim walls, a lit ceiling, a window on the left.
vec3 room(vec3 d) {
    vec3 light = mix(vec3(0.050, 0.036, 0.030), vec3(0.20, 0.23, 0.29), smoothstep(-0.25, 0.9, d.y));
    vec2 q = d.z > -0.8 ? vec2(d.x + 0.55, d.y - 0.52) : vec2(9.0);
    vec2 pane = abs(vec2(dot(q, vec2(0.94, -0.10)), q.y)) - vec2(0.20, 0.28);
    return light + vec3(2.6, 2.5, 2.3) * smoothstep(0.05, -0.03, max(pane.x, pane.y))
        * smoothstep(0.005, 0.03, abs(q.x));
}

void mainImage(out vec4 light, in vec2 fragCoord) {
    vec4 g = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec3 from;
    mat3 axes;
    camera(iMouse, iResolution.xy, iTime, from, axes);
    vec3 ray = axes * viewFromPixel(fragCoord, 1.0, iResolution.xy), backdrop = backdropOf(fragCoord / iResolution.xy);
    light = vec4(backdrop, 1.0);
    if (isNothing(g)) return;

    vec3 at = from + g.z * ray, n = axes * unpackNormal(g.xy), view = -normalize(ray), mirrored = reflect(-view, n);
    bool isTable = int(g.w) == TABLE_MATERIAL;
    float pixel = g.z / (FOCAL * unit(iResolution.xy)) / max(dot(n, view), 0.1);
    vec3 own = isTable ? walnut(at.xz, pixel) : paint(int(g.w));

    // What is hidden from the sky loses the sky's light; but light goes on between things of a colour (Jimenez et al.
    // 2016, section 5, have this fit), so what is left of it is not grey.
    float open = 1.0 - clamp(occlusion * texelFetch(iChannel1, ivec2(fragCoord), 0).r, 0.0, 1.0);
    vec3 a = 2.0404 * own - 0.3324, b = -4.7951 * own + 0.6417, c = 2.7552 * own + 0.6903;
    vec3 seen = max(vec3(open), ((open * a + b) * open + c) * open);

    // The G-buffer has one number for all diffuse light: 0.16 + 0.10 n.y of it are the sky's, 0.72 dot(n, SUN) the
    // sun's.
    float sun = clamp((fract(g.w) - 0.16 - 0.10 * n.y) / 0.72, 0.0, 1.0), facing = max(dot(n, SUN), 1e-4);
    float lit = min(sun / facing, 1.0);
    vec3 sky = mix(vec3(0.34, 0.27, 0.22), vec3(0.62, 0.74, 0.98), 0.5 + 0.5 * n.y);
    vec3 sunlight_ = vec3(2.30, 2.02, 1.66) * sun * (ambientOnly ? vec3(1.0) : mix(seen, vec3(1.0), 0.5));
    light.rgb = own * (0.62 * sky * seen + sunlight_);

    float shine = blinn ? dot(n, normalize(SUN + view)) : dot(mirrored, SUN);
    float fresnel = 0.04 + 0.96 * pow(1.0 - clamp(dot(n, view), 0.0, 1.0), 5.0);
    float highlight = lit * pow(max(shine, 0.0), shininess) * (shininess + 8.0) / 8.0;
    if (isTable) {
        light.rgb += 0.006 * vec3(1.0, 0.9, 0.76) * highlight;
        light.rgb = mix(light.rgb, backdrop, smoothstep(4.5, 13.5, length(at.xz)));
    } else {
        light.rgb += fresnel * (room(mirrored) * open + vec3(1.0, 0.92, 0.8) * highlight);
    }
}
