// MacCormack, there: from where it was half a step ago.
void mainImage(out vec4 carried, in vec2 fragCoord) {
    carried = vec4(bilinear(iChannel1, departure(iChannel0, fragCoord, 0.5 * dt)), 0.0, 1.0);
}
