void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    for (int i = 0; i < 4; i++) {
        float brightness = float(i) * 0.25;
    }
    fragColor = vec4(brightness);
}
