// GLSL ES 1.00: names that are keywords later, GL_ES, its version, loops with constant bounds.
#ifdef GL_ES
precision mediump float;
#define LEVEL 0.75
#else
#define LEVEL 0.1
#endif
uniform vec2 resolution;

float smooth(in float sample) { return sample * sample; }

void main() {
	vec3 texture = vec3(gl_FragCoord.xy / resolution, LEVEL);
	float buffer = 0.0;
	for (int i = 0; i < 4; i++) {
		buffer += smooth(texture.x) * 0.25;
	}
#if __VERSION__ == 100
	gl_FragColor = vec4(buffer, texture.y, texture.z, 1);
#else
	gl_FragColor = vec4(1.0);
#endif
}
