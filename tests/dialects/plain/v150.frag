#version 150
// A colour without alpha.
uniform vec2 uResolution;
uniform float levels[3];
in vec2 texcoord;
out vec3 color;

void main() {
    color = vec3(texcoord, 0.75 + levels[1]);
}
