struct Hit {
    float distance;
    int material;
};

Hit miss() { return Hit(1e9); }
Hit ground(vec3 p) { return Hit(p.y, 1.0); }

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(miss().distance + ground(vec3(0)).distance);
}
