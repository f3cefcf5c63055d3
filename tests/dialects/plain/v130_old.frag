#version 130
// The older words exist in 1.30: varying, texture2D and gl_FragColor.
uniform vec2 uResolution;
uniform sampler2D picture; // data/four.png
varying vec2 vUv;

void main() {
    int n = 3;
    n <<= 1;
    gl_FragColor = vec4(texture2D(picture, vUv).rgb * n / 6, 1);
}
