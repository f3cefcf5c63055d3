// The last frame is read without a filter, and its edges continue.
precision highp float;
uniform vec2 resolution;
uniform float time;
uniform sampler2D backbuffer;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec2 cell = floor(gl_FragCoord.xy / 4.0);
	vec4 moved = texture2D(backbuffer, at + vec2(-4.3, 3.3) / resolution);
	vec4 fresh = vec4(0.1 * cell.x + 0.05, 0.2 * cell.y + 0.05, 0.5, 1.0);
	gl_FragColor = time < 0.05 ? fresh : moved;
}
