// The velocity less the gradient of the pressure. Channel 0: the velocity just moved; channel 1: the pressure.

float pressureAt(ivec2 p) {
    return texelFetch(iChannel1, ivec2(mod(vec2(p), iResolution.xy)), 0).x;
}

void mainImage(out vec4 velocity, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 gradient = 0.5 * iResolution.y * vec2(pressureAt(p + ivec2(1, 0)) - pressureAt(p - ivec2(1, 0)),
                                               pressureAt(p + ivec2(0, 1)) - pressureAt(p - ivec2(0, 1)));
    velocity = vec4(texelFetch(iChannel0, p, 0).xy - gradient, 0.0, 0.0);
    if (!isFinite(velocity)) velocity = vec4(0.0);
}
