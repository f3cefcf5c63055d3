void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = texture(uv.x < 0.5 ? iChannel0 : iChannel1, uv);
}
