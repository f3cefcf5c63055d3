vec3 const tint = vec3(0.2, 0.4, 0.6);
float shade(float in x, float highp y) { return x * y; }
void mainImage(out vec4 fragColor, in vec2 fragCoord) { fragColor = vec4(tint * shade(0.5, 1.0), 1.0); }
