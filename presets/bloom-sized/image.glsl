// Mixes the bloom in and fits the light into what a screen can show. Channel 0 is Buffer A, channel 1 the bloom.

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec3 sharp = min(texelFetch(iChannel0, ivec2(fragCoord), 0).rgb, 65504.0); // a brighter one is infinite in 16 bits
    vec3 wide = tent(iChannel1, fragCoord, 1, iResolution.xy).rgb / scale();
    fragColor = vec4(sqrt(reinhard(mix(sharp, wide, strength) * exp2(exposure))), 1.0);
}
