void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 col = vec3(fragCoord / iResolution.xy, 0.5);
    col = pow(col, 0.4545);
    fragColor = vec4(col, 1.0);
}
