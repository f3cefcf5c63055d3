const int KERNEL = 16;
const float SIGMA = .02;
// A Gaussian over a square: the kernel reaches further than it needs to.
void mainImage(out vec4 color, in vec2 at) {
    vec4 sum = vec4(0);
    float d = .003 * iResolution.y;
    for (int y = -KERNEL; y <= KERNEL; y++)
    for (int x = -KERNEL; x <= KERNEL; x++) {
        vec2 by = vec2(x, y) * d / iResolution.y;
        sum += exp(-dot(by, by) / (SIGMA * SIGMA)) * vec4(texture(iChannel0, at / iResolution.xy + by * iResolution.yy / iResolution.xy).rgb, 1);
    }
    color = vec4(sum.rgb / sum.a, 1);
}
