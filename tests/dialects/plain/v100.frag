#version 100
#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif
// GLSL ES 1.00: varying, texture2D, gl_FragData, loops with constant bounds.
uniform vec2 uResolution;
uniform sampler2D picture; // data/four.png
varying vec2 vUv;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3; i++) sum += texture2D(picture, vUv + 0.05 * float(i)) / 3.0;
#ifdef GL_ES
    sum.b += 0.125;
#endif
    gl_FragData[0] = vec4(sum.rgb * (0.5 + 0.5 * vUv.x), 1.0);
}
