// The surface's unit normal (rgb) and height (a). Channel 0 is the height field.
//
// For a height h(x, y) the normal is (-dh/dx, -dh/dy, 1) made unit; the gradient is by central differences, whose error
// for a wave of wavenumber k is a factor sin(k) / k. Heights are in units of the canvas's height, so that a canvas of
// more pixels shows the same surface.

float heightOf(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    return texelFetch(iChannel0, max(min(p, size - 1), ivec2(0, min(1, size.y - 1))), 0).x;
}

void mainImage(out vec4 normal, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 gradient = 0.5 * iResolution.y * vec2(heightOf(p + ivec2(1, 0)) - heightOf(p - ivec2(1, 0)),
                                               heightOf(p + ivec2(0, 1)) - heightOf(p - ivec2(0, 1)));
    normal = vec4(normalize(vec3(-relief * 0.1 * gradient, 1.0)), heightOf(p));
}
