// Of a block of texels, the sums of u r, u lap u, r and u, where r is what is left: of iChannel0. u is in iChannel1.
void mainImage(out vec4 sums, in vec2 fragCoord) {
    ivec2 size = textureSize(iChannel0, 0), blocks = ivec2(iResolution.xy), block = (size + blocks - 1) / blocks;
    ivec2 from = ivec2(fragCoord) * block, to = min(from + block, size);
    sums = vec4(0.0);
    for (int y = from.y; y < to.y; ++y) {
        for (int x = from.x; x < to.x; ++x) {
            float u = u_at(iChannel1, ivec2(x, y)), r = texelFetch(iChannel0, ivec2(x, y), 0).y;
            sums += vec4(u * r, u * laplacian(iChannel1, ivec2(x, y)), r, u);
        }
    }
}
