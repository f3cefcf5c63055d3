void mainImage(out vec4 carried, in vec2 fragCoord) {
    vec2 u = at(iChannel0, ivec2(fragCoord));
    carried = vec4(bilinear(iChannel1, fragCoord - dt * u), 0.0, 1.0);
}
