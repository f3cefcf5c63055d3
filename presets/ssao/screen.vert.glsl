// The plane, over the whole picture.

in vec3 aPosition;

void main() {
    gl_Position = vec4(aPosition.x, -aPosition.z, 0.0, 1.0);
}
