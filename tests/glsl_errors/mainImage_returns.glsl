vec4 mainImage(in vec2 fragCoord)
{
    return vec4(fragCoord / iResolution.xy, 0.0, 1.0);
}
