#version 300 es
precision highp float;
// The names for the position from 0 to 1 that vertex stages give.
uniform float uTime;
in vec2 vUv;
in vec2 vUV;
in vec2 v_uv;
in vec2 uv;
in vec2 texcoord;
in vec2 vTexCoord;
in vec2 v_texCoord;
in vec2 texCoord;
out vec4 color;

void main() {
    vec2 mean = (vUv + vUV + v_uv + uv + texcoord + vTexCoord + v_texCoord + texCoord) / 8.0;
    color = vec4(mean, abs(vUv.x - texCoord.x) * 100.0 + 0.25, 1.0);
}
