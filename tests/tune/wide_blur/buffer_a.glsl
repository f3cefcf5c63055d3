// A pattern with sharp edges, and its blur along rows (buffer_b) and columns (image).
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = 4. * at / iResolution.y + .2 * iTime;
    color = vec4(step(.5, fract(p.x)) * vec3(1, .6, .2) + step(.7, fract(p.y)) * vec3(.1, .3, .7), 1);
}
