// Rings.
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = (2. * at - iResolution.xy) / iResolution.y;
    color = vec4(step(.5, fract(8. * length(p) - iTime)) * vec3(1, .5, .3) + step(.8, fract(5. * p.x)) * vec3(0, .3, .6), 1);
}
