void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float weights[3] = float[3](0.25, 0.5);
    int n = int(fragCoord.x);
    float samples[n];
    float grid[4][4];
    fragColor = vec4(weights[3]);
}
