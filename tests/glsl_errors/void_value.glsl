void tint(inout vec3 c) { c *= vec3(1.0, 0.5, 0.2); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 col = vec3(fragCoord / iResolution.xy, 1.0);
    col = tint(col);
    fragColor = vec4(col, 1.0);
}
