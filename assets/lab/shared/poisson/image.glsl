// Where f is about 1 and long waves are most of it, p grows with the square of the canvas.
void mainImage(out vec4 colour, in vec2 fragCoord) {
    float p = texelFetch(iChannel0, ivec2(fragCoord), 0).x;
    colour = vec4(vec3(0.5 + 10.0 * p / (iResolution.x * iResolution.y)), 1.0);
}
