// Buffers repeat and are filtered.
uniform sampler2D u_buffer0; // 4x4
varying vec2 v_texcoord;

void main() {
#ifdef BUFFER_0
    gl_FragColor = vec4(0.2 + 0.15 * floor(gl_FragCoord.x), 0.1 + 0.2 * floor(gl_FragCoord.y), 0.5, 1.0);
#else
    gl_FragColor = texture2D(u_buffer0, v_texcoord * 2.5 - 0.75);
#endif
}
