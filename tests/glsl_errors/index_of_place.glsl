void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    float a[4];
    vec3 points[2];
    a[int(1e30)] = 2.0;
    a[4]++;
    points[-1].x += 1.0;
    points[2].xy[0] = 1.0;
    modf(fragCoord.x, a[5]);
    fragColor = vec4(a[0]);
}
