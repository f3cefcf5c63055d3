// One sweep: lap p = div, where p has the step in it.
void mainImage(out vec4 pressure, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    float sum = pressureAt(iChannel0, p + ivec2(1, 0)) + pressureAt(iChannel0, p - ivec2(1, 0))
        + pressureAt(iChannel0, p + ivec2(0, 1)) + pressureAt(iChannel0, p - ivec2(0, 1));
    pressure = vec4(0.25 * (sum - at(iChannel1, p).x), 0.0, 0.0, 1.0);
}
