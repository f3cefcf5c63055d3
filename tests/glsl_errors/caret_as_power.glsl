void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float d = length(fragCoord) ^ 2.0;
    fragColor = vec4(d);
}
