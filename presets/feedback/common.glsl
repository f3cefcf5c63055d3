// Each channel of Buffer A is the trail of one pen: INK where the pen is now, and from then on less by the same factor
// every frame. Because the fade is exponential, a trail's logarithm is its age, and Image can colour it by age.

const float INK = 4.0;

// The factor a trail keeps each frame: exp(-33 / height). It is halved after
//     frames = height * ln(2) / 33 = 0.021 * height
// (5.7 frames on a canvas 270 pixels high, 23 at 1080). A pen that moves so many pixels a frame leaves a tail that is
// the same part of the picture at every size.
const float FADE = 33.0;

float kept(float canvasHeight) {
    return exp(-FADE / canvasHeight);
}

// NaN and infinity have all exponent bits set; what min() and max() make of a NaN is undefined (GLSL ES 3.00, section
// 4.5.1).
bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

// How many half-lives ago the pen was here.
float age(float trail) {
    return log2(INK / max(trail, 1e-20));
}

// Texel (0, 0) is not part of the picture. It keeps the mouse of the frame before: (x, y, 1 while held, canvas height).
const ivec2 MOUSE = ivec2(0, 0);
