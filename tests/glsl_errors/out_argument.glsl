void split(vec3 v, out vec2 a, out float b) { a = v.xy; b = v.z; }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 a;
    split(vec3(fragCoord, 1.0), a, 0.5);
    fragColor = vec4(a, 0.0, 1.0);
}
