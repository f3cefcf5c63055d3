// The picture of the last frame has 8 bits: it is limited to 0..1, and its steps are 1/255.
precision highp float;
uniform vec2 resolution;
uniform sampler2D backbuffer;

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec4 before = texture2D(backbuffer, at);
	// 0.7 of a step is rounded to a whole one in each frame, 0.3 is lost. Beyond 1 nothing is kept.
	float step = at.x < 0.5 ? 0.7 : 0.3;
	gl_FragColor = vec4(before.r + step / 255.0, before.g < 0.95 ? before.g + 0.3 : before.g - 0.5, 0.0, 1.0);
	if (at.y > 0.5) gl_FragColor.rb = vec2(before.r + 0.3 * at.x, before.b < 0.5 ? 1.5 : before.b - 0.25);
	if (at.y < 0.25) gl_FragColor.b = before.r * 30.0;
}
