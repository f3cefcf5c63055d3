struct Ray {
    vec3 origin;
    vec3 direction;
};

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    Ray r = Ray(vec3(0), vec3(fragCoord, 1.0));
    fragColor = vec4(r.orgin + r.dir, 1.0);
}
