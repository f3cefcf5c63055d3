void mainImage(out vec4 velocity, in vec2 fragCoord) {
    velocity = vec4(spreadAlong(iChannel0, ivec2(fragCoord), ivec2(0, 1)), 0.0, 1.0);
}
