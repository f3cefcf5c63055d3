void mainImage(out vec4 colour, in vec2 fragCoord) {
    vec2 w = texelFetch(iChannel0, ivec2(fragCoord), 0).xy;
    colour = vec4(vec3(1.0 - w.x, 2.0 * w.y, w.x), 1.0);
}
