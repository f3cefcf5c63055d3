// mouse: 20,5
precision mediump float;
uniform vec2 mouse;
uniform vec2 resolution;

void main() {
	vec2 at = gl_FragCoord.xy / resolution.xy;
	gl_FragColor = vec4(mouse, 1.0 - distance(at, mouse) * 0.6, 1.0);
}
