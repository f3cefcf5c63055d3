float noise(vec2 p, float scale) { return fract(sin(dot(p, vec2(12.9, 78.2))) * scale); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(noise(fragCoord));
}
