void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iresolution.xy;
    fragColor = vec4(uv, sin(itime), 1.0);
}
