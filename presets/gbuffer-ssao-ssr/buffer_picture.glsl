// The light and its reflection, as a screen shows them. Channel 0 is the G-buffer, 1 the ambient occlusion, 2 the
// reflections, 3 the light.

#iUniform int show = 0 in { 0, 3 }               // 0 all, 1 occlusion, 2 reflections, 3 the G-buffer
#iUniform float polish = 0.16 in { 0.0, 1.0 }    // how much the table mirrors from straight above
#iUniform float exposure = 0.5 in { -4.0, 4.0 } // in stops

void mainImage(out vec4 shown, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec4 g = texelFetch(iChannel0, p, 0), hit = texelFetch(iChannel2, p, 0);
    vec3 light = textureLod(iChannel3, fragCoord / iResolution.xy, 0.0).rgb, mirrored = vec3(0.0);
    if (!isNothing(g) && int(g.w) == TABLE_MATERIAL) {
        vec3 view = normalize(viewFromPixel(fragCoord, 1.0, iResolution.xy));
        float fresnel = polish + (1.0 - polish) * pow(1.0 - clamp(-dot(view, unpackNormal(g.xy)), 0.0, 1.0), 5.0);
        mirrored = mix(backdropOf(vec2(0.5, 0.85)), textureLod(iChannel3, hit.xy, 0.0).rgb, hit.z);
        light += fresnel * mirrored;
    }
    vec3 colour = pow(1.0 - exp(-exp2(exposure) * light), vec3(1.0 / 2.2));
    if (show == 1) colour = vec3(1.0 - texelFetch(iChannel1, p, 0).r);
    if (show == 2) colour = sqrt(hit.z * mirrored);
    if (show == 3) colour = isNothing(g) ? vec3(0.0) : 0.5 + 0.5 * unpackNormal(g.xy);
    shown = vec4(colour, 1.0);
}
