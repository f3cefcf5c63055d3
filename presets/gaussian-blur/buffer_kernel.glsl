// The weights, from the middle outwards, 0 beyond the last. Row 0: the Gaussian of the sigma asked for. Row 1: the nine
// taps that are handed from shader to shader, divided by their sum, which is 0.98.

const float CLASSIC[5] = float[5](0.16, 0.15, 0.12, 0.09, 0.05);

// exp(-x x / (2 s s)) at the texels from -REACH to REACH: its sum and its variance.
vec2 momentsOf(float s, int last) {
    float sum = 1.0, square = 0.0;
    for (int i = 1; i <= last; i++) {
        float weight = 2.0 * exp(-0.5 * float(i * i) / (s * s));
        sum += weight;
        square += float(i * i) * weight;
    }
    return vec2(sum, square / sum);
}

void mainImage(out vec4 weight, in vec2 fragCoord) {
    int i = int(fragCoord.x), last = reach(1);
    weight = vec4(0.0);
    if (fragCoord.y > 1.0) {
        if (i < 5) weight.x = CLASSIC[i] / 0.98;
        return;
    }
    if (i > last) return;
    // Samples of a bell, cut off, have not the bell's own variance: a wide one lacks its tails, of a narrow one the
    // texels beside the middle see too little. So the bell is made as wide as it takes.
    float low = 0.05, high = 2.0 * sigma;
    for (int j = 0; j < 26; j++) {
        float s = 0.5 * (low + high);
        if (momentsOf(s, last).y < sigma * sigma) low = s;
        else high = s;
    }
    weight.x = exp(-0.5 * float(i * i) / (high * high)) / momentsOf(high, last).x;
}
