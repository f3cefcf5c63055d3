float sphere(vec3 p)
{
    float d = length(p) - 1.0;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(sphere(vec3(fragCoord, 0.0)));
}
