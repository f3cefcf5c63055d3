void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float d = clamp(length(fragCoord) / 100.0, 0, 1);
    fragColor = vec4(d);
}
