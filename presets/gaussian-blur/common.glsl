// One Gaussian blur, made in three ways.
//
// A Gaussian is the only round kernel that is a product of one function of x and one of y, so a blur with it is a row
// pass and a column pass: 17 + 17 fetches a texel instead of 289.
//   1  taps          weights out to 3 sigma, divided by their sum, so that a white wall stays white
//   2  half of them  a linear sampler placed between two texels returns their weighted mean: neighbours share one
//   fetch.
//                    D. Rideout, "Efficient Gaussian blur with linear sampling", 2010
//   3  mip level     one trilinear fetch; its kernel is a square, and it depends on where in the mip texel one stands.
//                    L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983
// and, not beside the others, the nine taps 5 9 12 15 16 15 12 9 5 that most shaders have, whatever sigma says:
//   4  nine taps     over their sum, 98: of sigma 2.14, flatter than a Gaussian (kurtosis 2.16; a Gaussian has 3)
//   5  five fetches  the same by a linear sampler
//
// What they deliver (tests/it/preset_filters.rs). 1 and 2: the sum within 1e-6 and 1e-5, and sigma as asked for to four
// digits, 0.3 to 2.5; from samples of the Gaussian itself they are 0.0024 at sigma 1.8 and 0.0052 at 2.5 (L2,
// relative). 3, where each side of the picture is a power of two: at sigma 1, 1.8 and 2.5 a texel becomes a blot of
// sigma 0.87, 1.60 and 2.49, and is moved by up to 0.5, 1.3 and 2.1 texels along either axis, which counted in makes
// 1.00, 1.88 and 3.03.

#iUniform float sigma = 1.8 in { 0.3, 2.5 } step 0.1 // in texels
#iUniform int variant = 0 in { 0, 5 }                // 0: 1, 2 and 3 side by side
#iUniform float turning = 1.0 in { 0.0, 4.0 }        // how fast the card turns

const int REACH = 8, MIP = 3;

// Texels that a method's kernel reaches to either side.
int reach(int method) {
    return method > MIP ? 4 : clamp(int(ceil(3.0 * sigma)), 1, REACH);
}

int rowOf(int method) {
    return method > MIP ? 1 : 0;
}

bool isTaps(int method) {
    return method == 1 || method == 4;
}

// A box of n = 2^level texels, drawn out by a linear sampler, has the variance n^2 / 4 (mean over all phases).
float levelOfSigma() {
    return max(log2(2.0 * sigma), 0.0);
}

// The canvas is cut into three panels, or is one. Panel of column x: its first column, its number of columns, its
// method.
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
