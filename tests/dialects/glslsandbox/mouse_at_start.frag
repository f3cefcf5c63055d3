// Before the first move the pointer is in the centre.
precision mediump float;
uniform vec2 mouse;
uniform vec2 resolution;

void main() {
	gl_FragColor = vec4(mouse, gl_FragCoord.x / resolution.x, 1.0);
}
