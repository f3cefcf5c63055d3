void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 p = fragCoord - 0.5 * iResolution.xy;
    float angle = atan2(p.y, p.x);
    fragColor = vec4(fmod(angle, 1.0));
}
