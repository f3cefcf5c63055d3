void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float stripe = fragCoord.x % 10.0;
    fragColor = vec4(stripe / 10.0);
}
