void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 dir = normalize(vec3(fragCoord - 0.5 * iResolution.xy, iResolution.y));
    fragColor = texture(iChannel0, dir);
}
