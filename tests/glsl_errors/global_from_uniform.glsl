float speed = 2.0;
float t = iTime * speed;

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(sin(t));
}
