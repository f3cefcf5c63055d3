// Dye that shines: what it sends out is cut off as film does, 1 - exp(-x), so that the brightest turns white and keeps
// its hue around. Channel 0 is the dye.

vec3 dyeOf(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    if (size.y < 2) return vec3(0.0); // the one row there is holds the mouse
    return texelFetch(iChannel0, nearestCell(p, size), 0).rgb;
}

float thickness(ivec2 p) {
    return log(1.0 + dot(dyeOf(p), vec3(0.5, 0.8, 1.0)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float scale = iResolution.y / 270.0; // the same relief at every size
    int reach = max(int(scale), 1);
    vec2 slope = vec2(thickness(p + ivec2(reach, 0)) - thickness(p - ivec2(reach, 0)),
                      thickness(p + ivec2(0, reach)) - thickness(p - ivec2(0, reach))) * scale / float(reach);

    vec3 light = dyeOf(p) * exposure;
    // The rims of a sheet of dye, seen edge on, send out more than its face.
    light *= 0.75 + 1.5 * min(length(slope), 1.0);
    light += 0.10 * vec3(0.35, 0.6, 1.0) * thickness(p) * max(dot(slope, normalize(vec2(1.0, -1.3))), 0.0);
    vec3 water = mix(vec3(0.010, 0.016, 0.034), vec3(0.002, 0.003, 0.010), smoothstep(0.0, 1.0, length(uv)));
    vec3 shown = water + 1.0 - exp(-1.4 * light);
    shown = pow(shown, vec3(1.0 / 1.8));

    if (beyondTheMethod() && fragCoord.y < 0.03 * iResolution.y
        && mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y) {
        shown = vec3(0.85, 0.1, 0.1);
    }
    if (view != 0) shown = viewOf(CELL(iChannel1, p, ivec2(iResolution.xy)));
    fragColor = vec4(shown, 1.0);
}
