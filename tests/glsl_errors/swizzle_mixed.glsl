void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec4 a = iMouse.xyba;
    fragColor = a;
}
