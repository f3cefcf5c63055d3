// Before advection, so that it acts where the fluid comes from.
void mainImage(out vec4 diffused, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 u = at(iChannel0, p);
    vec2 beside = (at(iChannel0, p + ivec2(1, 0)) - u) + (at(iChannel0, p - ivec2(1, 0)) - u)
        + (at(iChannel0, p + ivec2(0, 1)) - u) + (at(iChannel0, p - ivec2(0, 1)) - u);
    diffused = vec4(u + dt * viscosity * beside, 0.0, 1.0);
}
