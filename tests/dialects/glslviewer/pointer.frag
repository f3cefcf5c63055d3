// pointer: 26,15
// The pointer moves without a pressed button.
uniform vec2 u_resolution;
uniform vec2 u_mouse;

void main() {
    gl_FragColor = vec4(u_mouse / u_resolution, gl_FragCoord.x / u_resolution.x, 1.0);
}
