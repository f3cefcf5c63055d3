// GLSL 1.10: names that are keywords later, no GL_ES, its version.
uniform vec2 u_resolution;
varying vec2 v_texcoord;

float smooth(float sample) { return sample * sample * (3.0 - 2.0 * sample); }

void main() {
    vec3 texture = vec3(v_texcoord, 0.25);
    float sample = smooth(texture.x);
    float buffer = 1.0, patch = 0.5, precise = 0.25, shared = 1.0;
#ifdef GL_ES
    buffer = 0.0;
#endif
#if __VERSION__ != 110
    patch = 1.0;
#endif
#ifndef GLSLVIEWER
    precise = 1.0;
#endif
    gl_FragColor = vec4(sample * buffer, texture.y * patch, precise + 0.5 * v_texcoord.x, shared);
}
