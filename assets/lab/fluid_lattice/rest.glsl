void mainImage(out vec4 rest, in vec2 fragCoord) {
    Cell f = cell(iChannel0, iChannel1, iChannel2, ivec2(fragCoord));
    rest = vec4(restAfter(f), 0.0, 0.0, 1.0);
}
