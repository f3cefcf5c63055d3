void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    if (fragCoord.x < 10.0) break;
    fragColor = vec4(1.0);
}
