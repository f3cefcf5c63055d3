// alpha, beta and gamma of the iteration, from the sums in iChannel0 and those of the iteration before in iChannel1.
void mainImage(out vec4 scalars, in vec2 fragCoord) {
    vec4 sums = texelFetch(iChannel0, ivec2(0), 0), last = texelFetch(iChannel1, ivec2(0), 0);
    ivec2 size = textureSize(iChannel2, 0);
    // (u, r) without the means of both: the constant wave is no part of the equation.
    float gamma = sums.x - sums.z * sums.w / float(size.x * size.y), delta = sums.y;
    float beta = 0.0, divisor = delta;
    if (abs(last.z) > 1e-30 && last.x != 0.0) {
        beta = gamma / last.z;
        divisor = delta - beta * gamma / last.x;
        // Only rounding gives it another sign than delta: begin with the direction of steepest descent.
        if (divisor * delta <= 0.0) {
            beta = 0.0;
            divisor = delta;
        }
    }
    // Nothing is left of a source that is solved for.
    scalars = vec4(divisor != 0.0 ? gamma / divisor : 0.0, beta, gamma, 1.0);
}
