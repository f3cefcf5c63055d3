void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float radius = 1;
    vec2 uv = fragCoord / iResolution.xy;
    fragColor = vec4(uv * radius, 0.0, 1.0);
}
