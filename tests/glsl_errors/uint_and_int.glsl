uint hash(uint x)
{
    x ^= x >> 16;
    x *= 0x7feb352d;
    return x;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(hash(uint(fragCoord.x)));
}
