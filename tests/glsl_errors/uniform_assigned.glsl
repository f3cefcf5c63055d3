void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    iTime *= 2.0;
    iMouse.xy /= iResolution.xy;
    fragColor = vec4(iTime);
}
