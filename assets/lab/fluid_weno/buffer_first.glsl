#include "weno.glsl"

// The first of three stages (Shu and Osher 1988): each is a mean of the beginning and a step of Euler's.
void mainImage(out vec4 velocity, in vec2 fragCoord) {
    velocity = vec4(stepped(iChannel0, ivec2(fragCoord)), 0.0, 1.0);
}
