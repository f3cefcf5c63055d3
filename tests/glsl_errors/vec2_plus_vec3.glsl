void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 p = vec3(1.0, 2.0, 3.0);
    p += fragCoord;
    fragColor = vec4(p, 1.0);
}
