#version 330
// Words about the interpolation of inputs.
uniform vec2 uResolution;
smooth in vec2 vUv;
centroid in vec2 texCoord;
out vec4 color;

void main() {
    color = vec4(vUv.x, texCoord.y, gl_FrontFacing ? 0.75 : 0.25, 1.0);
}
