// A text without a version line.
#ifdef GL_ES
precision mediump float;
#endif
uniform vec2 uResolution;
uniform float uTime;
varying vec2 vUv;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    gl_FragColor = vec4(at, vUv.x * 0.5 + uTime, 1.0);
}
