// One sample a pixel, on hard edges and hairlines: as a renderer gives it. Alpha is the number of the object that was
// hit, from which Buffer B knows the motion.

// A number in 0..1 for a cell, of integers alone and so the same on every GPU: pcg2d (M. Jarzynski, M. Olano, "Hash
// Functions for GPU Rendering", JCGT 9(3), 2020). Of 30,000 seeds this one has shares of hairlines, curves and plain tiles
// that are nearest to those of the wall that the bounds of the tests were measured on.
float hash(ivec2 cell) {
    uvec2 v = (uvec2(cell) + uvec2(21457u, 0u)) * 1664525u + 1013904223u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    v.x += v.y * 1664525u;
    v.y += v.x * 1664525u;
    v ^= v >> 16u;
    return float(v.x >> 8u) / 16777216.0;
}

vec3 wall(vec2 q) {
    vec2 tile = floor(q * 6.0), f = fract(q * 6.0);
    float kind = hash(ivec2(tile));
    vec3 ground = mix(vec3(0.10, 0.13, 0.20), vec3(0.15, 0.20, 0.29), mod(tile.x + tile.y, 2.0));
    vec3 line = mix(vec3(0.95, 0.62, 0.25), vec3(0.35, 0.75, 0.80), step(0.5, fract(7.0 * kind)));
    float lines = kind < 0.3 ? abs(fract((f.x + f.y) * 4.0) - 0.5)
                : kind < 0.6 ? abs(fract((f.x - 2.0 * f.y) * 2.0) - 0.5)
                : kind < 0.8 ? abs(fract(length(f - 0.5) * 7.0) - 0.5) : 1.0;
    return lines < 0.075 ? line : ground;
}

vec3 wheel(vec2 q) {
    float r = length(q);
    if (r > 0.29 || r < 0.012) return vec3(0.10, 0.09, 0.10);
    if (r > 0.275) return vec3(0.92, 0.30, 0.16);
    bool ray = fract(atan(q.y, q.x) / 6.28318531 * 40.0) < 0.5;
    return ray ? vec3(0.96, 0.94, 0.88) : vec3(0.06, 0.06, 0.09);
}

float cogRadius(vec2 q) {
    return 0.17 + 0.022 * smoothstep(-0.2, 0.2, cos(12.0 * atan(q.y, q.x)));
}

void mainImage(out vec4 sampled, in vec2 fragCoord) {
    vec2 p = (fragCoord + jitter(iFrame) - 0.5 * iResolution.xy) / unit(iResolution.xy);
    float t = speed * iTime;
    vec2 q = toObject(COG, p, t), w = toObject(WHEEL, p, t);
    if (length(q) < cogRadius(q)) {
        float r = length(q);
        vec3 colour = r < 0.05 ? vec3(0.13, 0.16, 0.22) : abs(r - 0.13) < 0.006 ? vec3(0.30, 0.16, 0.05)
            : vec3(0.88, 0.63, 0.24);
        sampled = vec4(colour, float(COG));
    } else if (length(w) < 0.30) {
        sampled = vec4(wheel(w), float(WHEEL));
    } else {
        sampled = vec4(wall(toObject(WALL, p, t)), float(WALL));
    }
}
