// The velocity of the grid: the mean of the particles' within a texel and a half. Those of five by five cells may
// have come so close.
void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 cell = ivec2(fragCoord);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 25; ++i) {
        ivec2 other = ivec2(i % 5, i / 5) - 2;
        for (int slot = 0; slot < MOST; ++slot) {
            vec4 particle = particleAt(iChannel0, cell + other, slot);
            vec2 away = vec2(other) + particle.xy - 0.5, d = abs(away);
            if (isEmpty(particle) || max(d.x, d.y) >= 1.5) continue;
            vec2 w = mix(0.75 - d * d, 0.5 * (1.5 - d) * (1.5 - d), vec2(greaterThan(d, vec2(0.5))));
            vec2 u = particle.zw;
#if METHOD == APIC
            vec4 affine = particleAt(iChannel1, cell + other, slot);
            u -= vec2(dot(affine.xy, away), dot(affine.zw, away));
#endif
            sum += w.x * w.y * vec3(u, 1.0);
        }
    }
    velocity = vec4(sum.z > 1e-4 ? sum.xy / sum.z : at(iChannel2, cell), 0.0, 1.0);
}
