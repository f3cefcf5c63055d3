void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 n = normalise(vec3(fragCoord, 1.0));
    float s = smoothStep(0.0, 1.0, n.x);
    fragColor = vec4(n * s, 1.0);
}
