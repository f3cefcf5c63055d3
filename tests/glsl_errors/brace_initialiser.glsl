void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float weights[3] = { 0.25, 0.5, 0.25 };
    fragColor = vec4(weights[0]);
}
