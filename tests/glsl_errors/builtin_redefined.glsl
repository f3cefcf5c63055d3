float round(float x) { return floor(x + 0.5); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(round(fragCoord.x));
}
