#version 130
// in and out, unsigned numbers, bits and switch; texture2D is still there.
uniform vec2 uResolution;
uniform sampler2D picture; // data/four.png
in vec2 vUv;
out vec4 color;

void main() {
    uint bits = (uint(gl_FragCoord.x) >> 2u) & 3u;
    float level = 0.0;
    switch (int(bits)) {
        case 0: level = 0.25; break;
        case 1:
        case 2: level = 0.5; break;
        default: level = 1.0;
    }
    color = vec4(level * vUv.y, texture(picture, vUv).rg, 1.0);
}
