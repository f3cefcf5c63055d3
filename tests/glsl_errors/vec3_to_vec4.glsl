void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 col = vec3(fragCoord / iResolution.xy, 0.0);
    fragColor = col;
}
