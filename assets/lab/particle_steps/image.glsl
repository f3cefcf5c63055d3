void mainImage(out vec4 colour, in vec2 fragCoord) {
    vec4 particle = texelFetch(iChannel0, ivec2(fragCoord), 0);
    colour = vec4(0.5 + 0.5 * particle.xy, length(particle.zw), 1.0);
}
