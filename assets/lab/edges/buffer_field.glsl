vec4 at(ivec2 p) {
    return texelFetch(iChannel0, clamp(p, ivec2(0), ivec2(iResolution.xy) - 1), 0);
}

void mainImage(out vec4 line, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    const ivec2 X = ivec2(1, 0), Y = ivec2(0, 1);
#if METHOD == ROBERTS
    vec4 a = at(p) - at(p + X + Y), b = at(p + X) - at(p + Y);
    vec4 size = sqrt(a * a + b * b);
#elif METHOD == SOBEL
    vec4 a = at(p + X - Y) + 2.0 * at(p + X) + at(p + X + Y) - at(p - X - Y) - 2.0 * at(p - X) - at(p - X + Y);
    vec4 b = at(p - X + Y) + 2.0 * at(p + Y) + at(p + X + Y) - at(p - X - Y) - 2.0 * at(p - Y) - at(p + X - Y);
    vec4 size = sqrt(a * a + b * b) / 4.0;
#else
    vec4 size = abs(at(p + X) + at(p - X) + at(p + Y) + at(p - Y) - 4.0 * at(p));
#endif
    // A turn by an angle moves the normal by twice the sine of its half.
    float depth = size.w / (0.02 * at(p).w), normal = length(size.xyz) / 0.55;
    line = vec4(sensitivity * max(depth, normal) > 1.0 ? 1.0 : 0.0);
}
