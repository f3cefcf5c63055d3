float luma(vec3 c)
{
    return c * vec3(0.2126, 0.7152, 0.0722);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(luma(vec3(fragCoord, 0.0)));
}
