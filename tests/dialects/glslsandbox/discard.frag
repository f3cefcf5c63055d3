// A target is cleared before it is drawn: pixels that are discarded are transparent black in the next frame.
precision highp float;
uniform vec2 resolution;
uniform float time;
uniform sampler2D backbuffer;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec4 before = texture2D(backbuffer, at);
	float frame = floor(time * 60.0 + 0.5);
	if (at.x < 0.5 && mod(frame, 4.0) > 1.5) discard;
	if (at.y > 0.8 && mod(frame, 4.0) < 2.5) discard;
	gl_FragColor = vec4(0.2 + 0.5 * before.a, at.y, before.g + 0.25, 0.75);
}
