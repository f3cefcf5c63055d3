// The alpha that a frame writes is read by the next one, and not shown.
precision highp float;
uniform vec2 resolution;
uniform sampler2D backbuffer;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec4 before = texture2D(backbuffer, at);
	gl_FragColor = vec4(before.a, before.a * 0.5, at.y, before.a * 0.5 + 0.4 * at.x);
}
