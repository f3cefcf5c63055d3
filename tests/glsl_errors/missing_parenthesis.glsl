void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float d = length(fragCoord - vec2(100.0, 50.0);
    fragColor = vec4(d);
}
