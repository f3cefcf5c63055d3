// The picture is shown as it is: alpha does not darken it.
precision mediump float;
uniform vec2 resolution;
uniform float time;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	gl_FragColor = vec4(0.9, at.x, 0.5 + time, at.y);
}
