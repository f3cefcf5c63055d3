float hash(float n) { return fract(sin(n) * 43758.5453); }
float hash(float x) { return fract(x * 17.0); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(hash(fragCoord.x));
}
