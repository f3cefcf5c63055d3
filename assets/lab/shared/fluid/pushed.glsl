// The viscosity along y, and half of the step's pressure as it is known before the step.
void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    velocity = vec4(spreadAlong(iChannel0, p, ivec2(0, 1)) - gradient(iChannel1, p), 0.0, 1.0);
}
