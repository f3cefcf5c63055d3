const float kernel[5] = float[](1, 4, 6, 4, 1);

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(kernel[int(fragCoord.x) % 5] / 16.0);
}
