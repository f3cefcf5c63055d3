#include "turn.glsl"

// What the five points of lap p make of a wave: -4 (sin^2(kx / 2) + sin^2(ky / 2)).
float symbol(ivec2 wave, ivec2 size) {
    float x = turn(wave.x, 2 * size.x).y, y = turn(wave.y, 2 * size.y).y;
    return -4.0 * (x * x + y * y);
}
