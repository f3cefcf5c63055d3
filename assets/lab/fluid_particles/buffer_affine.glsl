// The gradient of the velocity about each particle: of u in xy, of v in zw (Jiang et al., equation 8, with D = 1/4).
void mainImage(out vec4 affine, in vec2 fragCoord) {
    ivec2 slot = ivec2(fragCoord), cell = slot / SIDE;
    vec4 particle = texelFetch(iChannel0, slot, 0);
    affine = vec4(0.0);
    if (isEmpty(particle)) return;
    vec2[3] w = weights(particle.xy);
    for (int i = 0; i < 9; ++i) {
        ivec2 d = ivec2(i % 3, i / 3);
        vec2 u = at(iChannel1, cell + d - 1), away = vec2(d) - 0.5 - particle.xy;
        affine += 4.0 * w[d.x].x * w[d.y].y * vec4(u.x * away, u.y * away);
    }
}
