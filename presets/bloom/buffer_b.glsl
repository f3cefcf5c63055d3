// Packs the pyramid: each tile is the picture at its size. Channel 0 is Buffer A with its mip levels.

void mainImage(out vec4 packed, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    Tile t = tileAt(p, ivec2(iResolution.xy));
    packed = vec4(0.0);
    if (t.level == 0) return;
    vec2 inner = vec2(t.size - 2 * PAD);
    vec2 uv = (vec2(p - t.from - PAD) + 0.5) / inner;
    uv = clamp(uv, 0.5 / inner, 1.0 - 0.5 / inner); // the padding repeats the edge
    packed = textureLod(iChannel0, uv, float(t.level));
}
