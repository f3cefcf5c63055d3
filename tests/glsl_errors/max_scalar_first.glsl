void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 col = max(0.0, vec3(fragCoord, 1.0));
    fragColor = vec4(col, 1.0);
}
