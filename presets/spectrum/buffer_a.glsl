// Red: a spectrum on a scale of octaves, from 0 to 1, and older ones above it. Green in the lowest row: the wave, -1 to 1.

// The loudest of the bins between two frequencies; between two bins what lies on the line that joins them.
float loudest(float from, float to) {
    float first = from / BIN, last = to / BIN;
    float here = mix(texelFetch(iChannel0, ivec2(first, 0), 0).x, texelFetch(iChannel0, ivec2(first + 1.0, 0), 0).x,
                     fract(first));
    for (float bin = ceil(first); bin < last; bin++) here = max(here, texelFetch(iChannel0, ivec2(bin, 0), 0).x);
    return here;
}

// A row as it was; one that holds no level any more, as after a fault, is silence.
vec4 row(ivec2 texel) {
    vec4 held = texelFetch(iChannel1, texel, 0);
    return abs(held.x) <= 2.0 && abs(held.y) <= 1.0 ? held : vec4(0.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 texel = ivec2(fragCoord);
    vec4 before = row(texel);
    if (texel.y == 0) {
        float at = (fragCoord.x - 0.5) / iResolution.x, width = 1.0 / iResolution.x;
        float level = loudest(frequency(at), frequency(at + width));
        // High notes carry less than low ones: about 3 dB an octave less in most music, 11 of 255 steps of the analyser.
        level += 11.0 / 255.0 * at * log2(HIGHEST / LOWEST) * step(0.02, level);
        float fallen = before.x - 1.2 * iTimeDelta;
        fragColor = vec4(max(level, fallen), 2.0 * texelFetch(iChannel0, ivec2(texel.x, 1), 0).x - 1.0, 0.0, 1.0);
        return;
    }
    // The row below moves up when the clock of the rows has gone on.
    int steps = int(floor(iTime * RATE)) - int(floor((iTime - iTimeDelta) * RATE));
    fragColor = iFrame == 0 ? vec4(0.0) : steps == 0 ? before : row(texel - ivec2(0, min(steps, texel.y)));
}
