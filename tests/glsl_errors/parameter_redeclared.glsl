float box(vec3 p, vec3 b)
{
    vec3 p = abs(p) - b;
    return max(p.x, max(p.y, p.z));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(box(vec3(fragCoord, 0.0), vec3(1.0)));
}
