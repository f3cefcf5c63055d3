// Left the picture as it came, right the filtered one.

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float border = iMouse.x > 0.0 ? iMouse.x : 0.5 * iResolution.x;
    ivec2 texel = ivec2(fragCoord);
    vec3 colour = fragCoord.x < border ? texelFetch(iChannel0, texel, 0).rgb : texelFetch(iChannel1, texel, 0).rgb;
    if (abs(fragCoord.x - border) < 1.0) colour = vec3(1.0);
    fragColor = vec4(colour, 1.0);
}
