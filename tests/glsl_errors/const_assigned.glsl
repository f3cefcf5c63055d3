const vec3 light = vec3(1.0, 2.0, 3.0);

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    light.x = sin(iTime);
    fragColor = vec4(light, 1.0);
}
