float fractal(vec2 p, int depth)
{
    if (depth == 0) return length(p);
    return fractal(abs(p) - 0.5, depth - 1);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(fractal(fragCoord, 5));
}
