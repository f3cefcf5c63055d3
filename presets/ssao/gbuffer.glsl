// The three targets of the geometry pass: 32 bytes a texel together, which every device can draw into at once.

in vec3 vWorld;
in vec3 vView;
in vec3 vNormal;
in vec3 vColor;
layout(location = 0) out vec4 albedo;
layout(location = 1) out vec4 worldPosition;
layout(location = 2) out vec4 worldNormal;

// Albedo is kept as its square root: eight bits are few for what is dark.
void write(vec3 colour, float specular) {
    albedo = vec4(sqrt(colour), specular);
    worldPosition = vec4(vWorld, -vView.z);
    worldNormal = vec4(normalize(vNormal), 0.0);
}
