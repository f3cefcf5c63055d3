float circle(vec2 p, float r)
{
    return length(p) - r;
}
