// A pass of Stockham's transform, as in poisson_fft, of two complex numbers.
#ifndef RADIX
#define RADIX 1
#define SPAN 1
#define ALONG x
#define SIGN 1.0
#endif

void mainImage(out vec4 transformed, in vec2 fragCoord) {
    ivec2 place = ivec2(fragCoord), from = place, size = ivec2(iResolution.xy);
    int n = size.ALONG, o = place.ALONG;
    vec2 step_on = turn(o % (RADIX * SPAN), RADIX * SPAN) * vec2(1.0, SIGN), w = vec2(1.0, 0.0);
    from.ALONG = o / (RADIX * SPAN) * SPAN + o % SPAN;
    transformed = vec4(0.0);
    for (int r = 0; r < RADIX; ++r) {
        vec4 both = texelFetch(iChannel0, from, 0);
        transformed += vec4(times(both.xy, w), times(both.zw, w));
        w = times(w, step_on);
        from.ALONG += n / RADIX;
    }
}
