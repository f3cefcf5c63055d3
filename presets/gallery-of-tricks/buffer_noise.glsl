// A pattern that makes itself: what is near a texel feeds it, what is further off starves it (A. Turing, "The Chemical
// Basis of Morphogenesis", Phil. Trans. B 237, 1952, in the discrete form of D. Young, Math. Biosciences 72, 1984). x
// is its state, and 0 everywhere is a balance; a wave 10 texels long grows by some 7 % a frame. Left it starts from
// zeros, right from noise. Channel 0 is this buffer in the last frame.

#iUniform float tiny = 0.001 in { 0.0, 0.1 } // the noise that the right half starts from

const vec2 NEAR[4] = vec2[4](vec2(1.0, 0.0), vec2(0.0, 1.0), vec2(-1.0, 0.0), vec2(0.0, -1.0));
const vec2 FAR[8] = vec2[8](vec2(5, 0), vec2(4, 4), vec2(0, 5), vec2(-4, 4), vec2(-5, 0), vec2(-4, -4), vec2(0, -5),
                            vec2(4, -4));

float at(ivec2 p, int side, ivec2 size) {
    p = ivec2((p.x + size.x) % size.x + side * size.x, (p.y + size.y) % size.y);
    vec4 q = texelFetch(iChannel0, p, 0);
    return isFinite(q) ? q.x : 0.0;
}

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = ivec2(int(iResolution.x) / 2, int(iResolution.y));
    int side = p.x < size.x ? 0 : 1;
    p.x -= side * size.x;
    float own = at(p, side, size), near = own, far = 0.0;
    for (int i = 0; i < 4; i++) near += at(p + ivec2(NEAR[i]), side, size);
    for (int i = 0; i < 8; i++) far += at(p + ivec2(FAR[i]), side, size);
    float next = mix(own, tanh(1.9 * (near / 5.0 - far / 8.0)), 0.08);
    if (iFrame % restart == 0) next = side == 1 ? tiny * (2.0 * hash(fragCoord) - 1.0) : 0.0;
    state = vec4(next, 0.0, 0.0, 1.0);
}
