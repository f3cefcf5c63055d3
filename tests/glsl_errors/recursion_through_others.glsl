float scene(vec3 p);

float shadow(vec3 p) { return scene(p) * 0.5; }
float light(vec3 p) { return shadow(p + 1.0); }
float scene(vec3 p) { return light(p) + 1.0; }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(scene(vec3(fragCoord, 0.0)));
}
