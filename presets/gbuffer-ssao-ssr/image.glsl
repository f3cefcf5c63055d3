// The lighting. Channel 0 is the G-buffer, 1 the ambient occlusion, 2 the reflections.

#iUniform int show = 0 in { 0, 3 }               // 0 all, 1 occlusion, 2 reflections, 3 the G-buffer
#iUniform float occlusion = 1.0 in { 0.0, 2.0 }
#iUniform float polish = 0.22 in { 0.0, 1.0 }    // how much the table mirrors from straight above

vec3 paint(int material) {
    return material == 2 ? vec3(0.05, 0.28, 0.34) : material == 3 ? vec3(0.80, 0.42, 0.07)
         : material == 4 ? vec3(0.72, 0.06, 0.05) : material == 5 ? vec3(0.75, 0.73, 0.66) : vec3(0.055, 0.060, 0.075);
}

vec3 backdrop(vec2 uv) {
    return mix(vec3(0.020, 0.022, 0.030), vec3(0.115, 0.125, 0.150), smoothstep(1.1, 0.1, length(uv - vec2(0.5, 0.75))));
}

// The light a texel sends, its reflection left out. What is hidden from the sky loses the sky's part of the light; the blue
// of that is not grey, as the light goes on between things of a colour (Jimenez et al. 2016, section 5, has a fit for it).
vec3 lit(ivec2 p) {
    vec4 g = texelFetch(iChannel0, p, 0);
    if (isNothing(g)) return backdrop((vec2(p) + 0.5) / iResolution.xy);
    vec3 own = paint(int(g.w));
    float open = 1.0 - clamp(occlusion * texelFetch(iChannel1, p, 0).r, 0.0, 1.0);
    vec3 seen = max(vec3(open), ((open * (2.0404 * own - 0.3324) + (-4.7951 * own + 0.6417)) * open + (2.7552 * own + 0.6903)) * open);
    float light = fract(g.w), sun = max(light - 0.26, 0.0);
    vec3 colour = own * (min(light, 0.26) * vec3(0.85, 0.95, 1.25) * seen * 1.5 + 1.9 * sun * vec3(1.10, 1.0, 0.86) * mix(seen, vec3(1.0), 0.6));
    vec3 view = normalize(viewFromPixel(vec2(p) + 0.5, 1.0, iResolution.xy)), n = unpackNormal(g.xy);
    float rim = pow(1.0 - max(-dot(view, n), 0.0), 4.0);
    return int(g.w) == TABLE_MATERIAL ? colour : colour + 0.10 * rim * seen * (0.3 + light);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), last = ivec2(iResolution.xy) - 1;
    vec4 g = texelFetch(iChannel0, p, 0), hit = texelFetch(iChannel2, p, 0);
    vec3 light = lit(p);
    vec3 mirrored = vec3(0.0);
    float fresnel = 0.0;
    if (!isNothing(g) && int(g.w) == TABLE_MATERIAL) {
        vec3 view = normalize(viewFromPixel(fragCoord, 1.0, iResolution.xy));
        fresnel = polish + (1.0 - polish) * pow(1.0 - max(-dot(view, unpackNormal(g.xy)), 0.0), 5.0);
        // Bilinear by hand, so that a mirrored edge is as smooth as the thing's own.
        vec2 at = hit.xy * iResolution.xy - 0.5, f = fract(at);
        ivec2 i = ivec2(floor(at));
        if (hit.z > 0.0) {
            mirrored = mix(mix(lit(clamp(i, ivec2(0), last)), lit(clamp(i + ivec2(1, 0), ivec2(0), last)), f.x),
                           mix(lit(clamp(i + ivec2(0, 1), ivec2(0), last)), lit(clamp(i + 1, ivec2(0), last)), f.x), f.y);
        }
        mirrored = mix(backdrop(vec2(0.5, 0.75)), mirrored, hit.z);
        light += fresnel * mirrored;
    }
    vec3 shown = pow(1.0 - exp(-1.9 * light), vec3(1.0 / 2.2));
    if (show == 1) shown = vec3(1.0 - texelFetch(iChannel1, p, 0).r);
    if (show == 2) shown = sqrt(hit.z * mirrored);
    if (show == 3) shown = isNothing(g) ? vec3(0.0) : 0.5 + 0.5 * unpackNormal(g.xy);
    fragColor = vec4(shown, 1.0);
}
