void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float sum = 0.0;
    for (int i = 0; i < 8; i++) {
        sum += sin(iTime + i * 0.5);
    }
    fragColor = vec4(sum);
}
