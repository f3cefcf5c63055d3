// The picture. Channels 0 and 1 are the lamp's light and that of the surroundings, channel 2 the mode.
//
// Edges are smoothed along their direction: T. Lottes, "FXAA", NVIDIA 2009, in its shortest form.

#iUniform bool ambientOnly = false // true: what is hidden loses the surroundings' light; false: some of the lamp's too

vec3 backdrop(vec2 uv) {
    return mix(vec3(0.016, 0.019, 0.026), vec3(0.075, 0.080, 0.095),
               smoothstep(0.9, 0.1, length(uv - vec2(0.5, 0.55))));
}

// A texel as it is shown.
vec3 shown(ivec2 p) {
    p = clamp(p, ivec2(0), ivec2(iResolution.xy) - 1);
    vec4 direct = texelFetch(iChannel0, p, 0), surrounding = texelFetch(iChannel1, p, 0);
    int mode = int(texelFetch(iChannel2, ivec2(0), 0).x);
    float open = direct.a;
    if (mode == 2) return vec3(open);
    vec3 light = direct.rgb * (mode == 0 && !ambientOnly ? mix(1.0, open, 0.55) : 1.0)
        + surrounding.rgb * (mode == 0 ? open : 1.0);
    if (dot(surrounding.rgb, vec3(1.0)) == 0.0) light = backdrop((vec2(p) + 0.5) / iResolution.xy);
    return pow(1.0 - exp(-1.6 * light), vec3(1.0 / 2.2));
}

float luma(vec3 c) {
    return dot(c, vec3(0.299, 0.587, 0.114));
}

// Between texels.
vec3 between(vec2 at) {
    vec2 i = floor(at - 0.5), f = at - 0.5 - i;
    ivec2 p = ivec2(i);
    return mix(mix(shown(p), shown(p + ivec2(1, 0)), f.x), mix(shown(p + ivec2(0, 1)), shown(p + 1), f.x), f.y);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec3 middle = shown(p);
    float m = luma(middle), nw = luma(shown(p + ivec2(-1, 1))), ne = luma(shown(p + 1));
    float sw = luma(shown(p - 1)), se = luma(shown(p + ivec2(1, -1)));
    float low = min(m, min(min(nw, ne), min(sw, se))), high = max(m, max(max(nw, ne), max(sw, se)));
    vec3 colour = middle;
    if (high - low > max(0.03, 0.1 * high)) {
        vec2 along = vec2(sw + se - nw - ne, ne + se - nw - sw); // at right angles to the gradient
        float least = min(abs(along.x), abs(along.y)) + max(0.03 * (nw + ne + sw + se), 0.008);
        float reach = clamp(iResolution.y / 45.0, 1.0, 6.0);
        along = clamp(along / least, -reach, reach);
        vec3 near = 0.5 * (between(fragCoord - along / 6.0) + between(fragCoord + along / 6.0));
        vec3 wide = 0.5 * near + 0.25 * (between(fragCoord - 0.5 * along) + between(fragCoord + 0.5 * along));
        colour = luma(wide) < low || luma(wide) > high ? near : wide;
    }
    fragColor = vec4(colour, 1.0);
}
