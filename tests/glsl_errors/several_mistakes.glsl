#define PI 3.14159

float wave(float x, int octaves)
{
    float sum = 0;
    for (int i = 0; i < octaves; i++)
        sum += sin(x * pow(2.0, i)) / i;
    return sum;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = fragCoord / iResolution;
    float w = wave(uv.x * PI, 4.0);
    fragColor = vec4(vec3(w), 1.0)
}
