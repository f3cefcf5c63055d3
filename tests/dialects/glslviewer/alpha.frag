// The picture is blended over black.
uniform vec2 u_resolution;
varying vec2 v_texcoord;

void main() {
    gl_FragColor = vec4(0.9, gl_FragCoord.y / u_resolution.y, 0.5, 1.5 * v_texcoord.x - 0.2);
}
