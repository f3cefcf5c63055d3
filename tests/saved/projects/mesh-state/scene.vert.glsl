in vec3 aPosition;
in vec3 aNormal;
out vec3 vNormal;
void main() {
    vNormal = iNormalMatrix * aNormal;
    gl_Position = iProjection * iView * iModel * vec4(aPosition, 1.0);
}
