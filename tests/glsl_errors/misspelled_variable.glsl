void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 colour = vec3(fragCoord / iResolution.xy, 0.0);
    color *= 0.5;
    fragColor = vec4(color, 1.0);
}
