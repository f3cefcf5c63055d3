// MacCormack, and back: half of what there and back has changed is put right.
void mainImage(out vec4 star, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 back = bilinear(iChannel2, departure(iChannel0, fragCoord, -dt));
    star = vec4(at(iChannel2, p) + 0.5 * (at(iChannel1, p) - back), 0.0, 1.0);
}
