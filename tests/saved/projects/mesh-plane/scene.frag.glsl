in vec3 vNormal;
layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 normal;
void main() { albedo = vec4(0.8, 0.5, 0.2, 1.0); normal = vec4(0.5 + 0.5 * normalize(vNormal), 1.0); }
