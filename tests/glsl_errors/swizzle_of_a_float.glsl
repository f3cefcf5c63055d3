float sphere(vec3 p) { return length(p) - 1.0; }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(sphere(vec3(fragCoord, 1.0)).x);
}
