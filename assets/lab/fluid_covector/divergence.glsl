void mainImage(out vec4 divergence, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 here = at(iChannel0, p), next = vec2(at(iChannel0, p + ivec2(1, 0)).x, at(iChannel0, p + ivec2(0, 1)).y);
    divergence = vec4(next.x - here.x + next.y - here.y, 0.0, 0.0, 1.0);
}
