// One texel: 0 with occlusion, 1 without, 2 the occlusion alone. Each press of Space is a step. Channel 0 is this
// buffer in the last frame, channel 1 the keyboard.

const int SPACE = 32;

void mainImage(out vec4 mode, in vec2 fragCoord) {
    float before = texelFetch(iChannel0, ivec2(0), 0).x, pressed = texelFetch(iChannel1, ivec2(SPACE, 1), 0).x;
    if ((floatBitsToUint(before) & 0x7f800000u) == 0x7f800000u) before = 0.0; // NaN and infinity would stay
    mode = vec4(mod(before + step(0.5, pressed), 3.0), 0.0, 0.0, 1.0);
}
