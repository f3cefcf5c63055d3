// Of a block of texels, their sum.
void mainImage(out vec4 sums, in vec2 fragCoord) {
    ivec2 size = textureSize(iChannel0, 0), blocks = ivec2(iResolution.xy), block = (size + blocks - 1) / blocks;
    ivec2 from = ivec2(fragCoord) * block, to = min(from + block, size);
    sums = vec4(0.0);
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) sums += texelFetch(iChannel0, ivec2(x, y), 0);
    }
}
