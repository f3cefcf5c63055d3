#ifdef GL_ES
precision highp float;
#endif
#extension GL_OES_standard_derivatives : enable

uniform float time;
uniform vec2 resolution;
uniform vec2 surfaceSize;

void main( void ) {
	vec2 at = gl_FragCoord.xy / resolution;
	vec3 color = vec3(at, 0.5);
	if (at.x > 0.33) color = vec3(time * 5.0, time, at.y);
	if (at.x > 0.66) color = vec3(surfaceSize / 2.0, resolution.y / 32.0);
	gl_FragColor = vec4(color, 1.0);
}
