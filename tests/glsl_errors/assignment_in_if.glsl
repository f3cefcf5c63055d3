void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    int mode = 0;
    if (mode = 1) fragColor = vec4(1.0);
}
