// The same balls. No discard and no test: eddy.toml has a region for this pass, and only those texels are drawn.
// Channel 0 is this buffer in the last frame.

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    state = ballStep(texelFetch(iChannel0, p, 0), p.x, iFrame % restart == 0);
}
