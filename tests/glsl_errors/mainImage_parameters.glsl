void mainImage(out vec4 fragColor, in vec3 fragCoord)
{
    fragColor = vec4(fragCoord, 1.0);
}
