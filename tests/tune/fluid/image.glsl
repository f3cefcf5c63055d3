void mainImage(out vec4 color, in vec2 at) {
    vec2 v = texture(iChannel0, at / iResolution.xy).xy;
    color = vec4(.5 + .5 * cos(vec3(0, 2, 4) + atan(v.y, v.x)) * min(4. * length(v), 1.), 1);
}
