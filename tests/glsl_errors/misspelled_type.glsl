vce3 palette(float t)
{
    return vec3(t);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(palette(0.5), 1.0);
}
