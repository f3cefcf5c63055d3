void mainImage(out vec4 carried, in vec2 fragCoord) {
    carried = vec4(bilinear(iChannel0, origin(fragCoord, turn)), 0.0, 1.0);
}
