#version 110
// The oldest version: no precisions, no GL_ES, and names that are keywords later.
uniform float uTime;
uniform vec2 uResolution;

float smooth(float sample) { return sample * sample; }

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    vec3 texture = vec3(at, uTime);
#ifdef GL_ES
    texture = vec3(0.0);
#endif
#if __VERSION__ == 110
    texture.z += 0.5;
#endif
    gl_FragColor = vec4(smooth(texture.x), texture.y, texture.z, 1.0);
}
