void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    velocity = vec4(at(iChannel0, p) - gradient(iChannel1, p), 0.0, 1.0);
}
