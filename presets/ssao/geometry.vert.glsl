// Every mesh of the scene: to the world, to the camera, to the picture.

in vec3 aPosition;
in vec3 aNormal;
in vec4 aColor;
out vec3 vWorld;
out vec3 vView;
out vec3 vNormal;
out vec3 vColor;

void main() {
    vec4 world = iModel * vec4(aPosition, 1.0), view = iView * world;
    vWorld = world.xyz;
    vView = view.xyz;
    vNormal = iNormalMatrix * aNormal;
    vColor = aColor.rgb;
    gl_Position = iProjection * view;
    gl_Position.xy *= fit(iResolution.xy);
}
