// The middle of the step: not less the gradient that a projection would take away, but less it twice, so that the second
// half of the step begins with the push of the pressure which it lacks.
void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    velocity = vec4(at(iChannel0, p) - 2.0 * gradient(iChannel1, p), 0.0, 1.0);
}
