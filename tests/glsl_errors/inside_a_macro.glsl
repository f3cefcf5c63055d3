#define ROTATE(p, a) p = mat2(cos(a), sin(a), -sin(a), cos(a)) * p
#define HALF 1 / 2

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec3 p = vec3(fragCoord, 0.0);
    ROTATE(p, iTime);
    fragColor = vec4(p * HALF, 1.0);
}
