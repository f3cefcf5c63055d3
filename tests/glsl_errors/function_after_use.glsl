void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(scene(fragCoord));
}

float scene(vec2 p)
{
    return length(p) - 1.0;
}
