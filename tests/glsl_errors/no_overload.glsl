float hash(float x) { return fract(sin(x) * 43758.5); }
float hash(vec2 p) { return hash(dot(p, vec2(127.1, 311.7))); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(hash(ivec2(fragCoord)));
}
