// A target is cleared before it is drawn: pixels that are discarded are transparent black in the next frame.
precision highp float;
uniform vec2 resolution;
uniform float time;
uniform sampler2D backbuffer;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec4 before = texture2D(backbuffer, at);
	bool odd = mod(floor(time * 60.0 + 0.5), 2.0) > 0.5;
	if (at.x < 0.5 && !odd) discard;
	if (at.y > 0.8 && odd) discard;
	gl_FragColor = vec4(0.2 + 0.5 * before.a, at.y, before.g + 0.25, 0.75);
}
