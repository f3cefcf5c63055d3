float sphere(vec3 p, float r) { return length(p) - r; }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(sphere(fragCoord, 1));
}
