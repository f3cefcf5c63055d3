// The names of uniforms are free for parameters and locals.
precision highp float;
uniform float time;
uniform vec2 resolution;
uniform vec2 mouse;

vec3 shade(vec2 resolution, float time) {
	vec2 mouse = resolution * 0.5;
	return vec3(mouse, time);
}

void main() {
	vec2 at = gl_FragCoord.xy / resolution;
	vec3 color = shade(at, 0.6);
	{
		float time = at.y;
		color.z *= 0.5 + 0.5 * time;
	}
	gl_FragColor = vec4(color + vec3(0.0, time, 0.0), 1.0);
}
