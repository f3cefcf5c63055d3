// The picture, edges smoothed along their direction: T. Lottes, "FXAA", NVIDIA 2009, in its shortest form. Channel 0 is
// the picture as a screen shows it.

vec3 shown(vec2 at) {
    return textureLod(iChannel0, at / iResolution.xy, 0.0).rgb;
}

float luma(vec3 c) {
    return dot(c, vec3(0.299, 0.587, 0.114));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 middle = shown(fragCoord);
    float m = luma(middle), nw = luma(shown(fragCoord + vec2(-1.0, 1.0))), ne = luma(shown(fragCoord + 1.0));
    float sw = luma(shown(fragCoord - 1.0)), se = luma(shown(fragCoord + vec2(1.0, -1.0)));
    float low = min(m, min(min(nw, ne), min(sw, se))), high = max(m, max(max(nw, ne), max(sw, se)));
    vec3 colour = middle;
    if (high - low > max(0.03, 0.1 * high)) {
        vec2 along = vec2(sw + se - nw - ne, ne + se - nw - sw); // at right angles to the gradient
        float least = min(abs(along.x), abs(along.y)) + max(0.03 * (nw + ne + sw + se), 0.008);
        float reach = clamp(iResolution.y / 45.0, 1.0, 6.0);
        along = clamp(along / least, -reach, reach);
        vec3 near = 0.5 * (shown(fragCoord - along / 6.0) + shown(fragCoord + along / 6.0));
        vec3 wide = 0.5 * near + 0.25 * (shown(fragCoord - 0.5 * along) + shown(fragCoord + 0.5 * along));
        colour = luma(wide) < low || luma(wide) > high ? near : wide;
    }
    fragColor = vec4(colour, 1.0);
}
