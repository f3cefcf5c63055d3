// The frame's number keeps it from resting.
void mainImage(out vec4 texel, in vec2 fragCoord) {
    texel = vec4(iFrame & 1);
}
