void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    sampler2D tex = iChannel0;
    fragColor = texture(tex, fragCoord / iResolution.xy);
}
