mat3 rotate(float a)
{
    float s = sin(a), c = cos(a);
    return mat3(c, s, 0, -s, c, 0, 0, 0, 1);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 p = rotate(iTime) * fragCoord;
    fragColor = vec4(p, 0.0, 1.0);
}
