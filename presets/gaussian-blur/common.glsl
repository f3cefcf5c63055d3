// One Gaussian blur, made in three ways.
//
// A Gaussian is the only round kernel that is a product of one function of x and one of y, so a blur with it is a row pass
// and a column pass: 9 + 9 fetches a texel instead of 81.
//   1  nine taps     the weights at -4 .. 4, divided by their sum, so that a white wall stays white
//   2  five fetches  a linear sampler placed between two texels returns their weighted mean: neighbours share one fetch.
//                    D. Rideout, "Efficient Gaussian blur with linear sampling", 2010
//   3  mip level     one trilinear fetch; its kernel is a square, and it depends on where in the mip texel one stands.
//                    L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983
// The first two agree to the digits a sampler keeps of a fraction (8 bits on most GPUs: 1/512 of a neighbour's difference).

#iUniform float sigma = 1.8 in { 0.3, 2.5 } step 0.1 // in texels; nine taps reach 4, which is 3 sigma at 1.33
#iUniform int variant = 0 in { 0, 3 }                // 0: side by side; 1 nine taps, 2 five fetches, 3 mip level
#iUniform float turning = 1.0 in { 0.0, 4.0 }        // how fast the card turns

const int REACH = 4;

// Not divided by the sum yet.
float bell(float x) {
    return exp(-0.5 * x * x / (sigma * sigma));
}

float bellSum() {
    float sum = bell(0.0);
    for (int i = 1; i <= REACH; i++) sum += 2.0 * bell(float(i));
    return sum;
}

// A box of n = 2^level texels, drawn out by a linear sampler, has the variance n^2 / 4 (mean over all phases).
float levelOfSigma() {
    return max(log2(2.0 * sigma), 0.0);
}

// The canvas is cut into three panels, or is one. Panel of column x: its first column, its number of columns, its method.
ivec3 panelOf(int x, int width) {
    if (variant > 0) return ivec3(0, width, variant);
    int i = clamp(x * 3 / max(width, 1), 0, 2);
    int from = (i * width + 2) / 3, to = ((i + 1) * width + 2) / 3;
    return ivec3(from, max(to - from, 1), i + 1);
}

// Below the card a panel shows the response to a single bright texel. Where it lies, and the square it is magnified to.
ivec2 impulseOf(ivec3 panel, int height) {
    return ivec2(panel.x + panel.y / 2, height / 8);
}
