precision highp float;
varying vec2 surfacePosition;
uniform float time;

void main() {
	gl_FragColor = vec4(0.5 + 0.5 * surfacePosition, 1.0 - 0.8 * length(surfacePosition), 1.0);
}
