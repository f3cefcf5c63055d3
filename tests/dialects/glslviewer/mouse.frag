// mouse: 20,5
#ifdef GL_ES
precision mediump float;
#endif
uniform vec2 u_resolution;
uniform vec2 u_mouse;

void main() {
    vec2 there = u_mouse / u_resolution;
    float near = 1.0 - distance(gl_FragCoord.xy, u_mouse) / 40.0;
    gl_FragColor = vec4(there, near, 1.0);
}
