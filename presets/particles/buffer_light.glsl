// The exposure. Channel 0 is this buffer in the last frame, channel 1 the tiles, channel 2 the motion, channel 3 the
// ages.

vec3 colourOf(vec4 life) {
    float t = clamp(life.x / life.y, 0.0, 1.0);
    if (life.z == DUST) return vec3(0.10, 0.22, 0.50) * smoothstep(0.0, 0.15, t) * smoothstep(1.0, 0.7, t);
    if (life.z == SPARK) return mix(vec3(2.6, 1.7, 0.7), vec3(1.1, 0.16, 0.04), smoothstep(0.0, 0.7, t)) * (1.0 - t);
    return vec3(0.35, 1.0, 0.55) * smoothstep(0.0, 0.1, t) * smoothstep(1.0, 0.9, t);
}

void mainImage(out vec4 light, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    ivec2 tile = min(ivec2(fragCoord * vec2(TILES) / iResolution.xy), TILES - 1);
    vec2 at = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float seconds = clamp(speed * iTimeDelta, 0.0, 0.5);

    vec4 before = texelFetch(iChannel0, p, 0);
    vec3 sum = isFinite(before) ? before.rgb * exp(-iTimeDelta / exposure_seconds) : vec3(0.0);
    bool more = true;
    for (int s = 0; s < TILE * TILE; s++) {
        if (!more) break;
        vec4 numbers = texelFetch(iChannel1, TILE * tile + ivec2(s % TILE, s / TILE), 0);
        for (int k = 0; k < 4; k++) {
            int n = int(numbers[k]) - 1;
            if (n < 0 || n >= COUNT) { more = false; break; }
            vec4 m = texelFetch(iChannel2, texelOf(n), 0), life = texelFetch(iChannel3, texelOf(n), 0);
            // Drawn as the streak of its last step, unless it was only just born.
            vec2 from = life.x > 0.0 ? m.xy - seconds * m.zw : m.xy;
            float radius = radiusOf(life.z, iResolution.y), wanted = radiusOf(life.z, 1e9);
            float d = segmentDistance(at, from, m.xy) / radius;
            sum += brightness * wanted / radius * colourOf(life) * exp(-d * d) * min(12.0 * iTimeDelta, 1.0);
        }
    }
    light = vec4(sum, 1.0);
}
