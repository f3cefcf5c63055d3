void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    const float aspect = iResolution.x / iResolution.y;
    fragColor = vec4(aspect);
}
