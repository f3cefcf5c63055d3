// The same in 8 x 8 parts.

void mainImage(out vec4 most, in vec2 fragCoord) {
    ivec2 low = 8 * ivec2(fragCoord);
    float slope = 0.0;
    for (int i = 0; i < 64; i++) slope = max(slope, texelFetch(iChannel0, low + ivec2(i % 8, i / 8), 0).x);
    most = vec4(slope, 0.0, 0.0, 0.0);
}
