void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float depth = fragCoord.z;
    fragColor = vec4(depth);
}
