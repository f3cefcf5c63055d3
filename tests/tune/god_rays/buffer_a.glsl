// A lamp behind pillars.
void mainImage(out vec4 color, in vec2 at) {
    vec2 p = (2. * at - iResolution.xy) / iResolution.y;
    float pillar = smoothstep(.05, .1, abs(fract(2. * p.x + .2 * iTime) - .5));
    color = vec4(vec3(1, .9, .7) * exp(-4. * dot(p, p)) * pillar, 1);
}
