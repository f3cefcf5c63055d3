void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iResolution.xy;
    if (uv > vec2(0.5)) fragColor = vec4(1.0);
}
