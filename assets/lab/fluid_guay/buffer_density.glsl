void mainImage(out vec4 rho, in vec2 fragCoord) {
    rho = vec4(density(iChannel0, ivec2(fragCoord)), 0.0, 0.0, 1.0);
}
