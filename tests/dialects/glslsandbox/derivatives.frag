#extension GL_OES_standard_derivatives : enable
precision highp float;
uniform vec2 resolution;
varying vec2 surfacePosition;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	gl_FragColor = vec4(dFdx(at.x) * 16.0, fwidth(at.y) * 9.0, abs(dFdy(surfacePosition.y)) * 6.0, 1.0);
}
