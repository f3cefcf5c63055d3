// A pass of Stockham's transform, whose passes leave their results in order (Cochran et al. 1967; Van Loan, Computational
// Frameworks for the Fast Fourier Transform, section 1.7). RADIX sums of SPAN terms become one of RADIX SPAN, along an axis:
// out[o] = sum over r of in[j + r N / RADIX] w^(r (o mod RADIX SPAN)), where w is SIGN one (RADIX SPAN)-th of a turn and
// j = floor(o / (RADIX SPAN)) SPAN + o mod SPAN.
#ifndef RADIX
#define RADIX 1
#define SPAN 1
#define ALONG x
#define SIGN 1.0
#endif

void mainImage(out vec4 transformed, in vec2 fragCoord) {
    ivec2 place = ivec2(fragCoord), size = ivec2(iResolution.xy);
    int n = size.ALONG, o = place.ALONG;
    vec2 step_on = turn(o % (RADIX * SPAN), RADIX * SPAN) * vec2(1.0, SIGN), w = vec2(1.0, 0.0), sum = vec2(0.0);
    ivec2 from = place;
    from.ALONG = o / (RADIX * SPAN) * SPAN + o % SPAN;
    for (int r = 0; r < RADIX; ++r) {
        sum += times(texelFetch(iChannel0, from, 0).xy, w);
        w = times(w, step_on);
        from.ALONG += n / RADIX;
    }
#ifdef DIVIDE
    // The last pass of the way there: each wave is divided by its symbol, and by the texels, as a transform and its inverse
    // multiply by their number. The constant wave is no part of the equation.
    bool constant = place == ivec2(0);
    sum = constant ? vec2(0.0) : sum / (symbol(place, size) * float(size.x * size.y));
#endif
    transformed = vec4(sum, 0.0, 1.0);
}
