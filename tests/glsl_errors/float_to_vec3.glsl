void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 col = 0.5 + 0.5 * cos(iTime);
    fragColor = vec4(col, 1.0);
}
