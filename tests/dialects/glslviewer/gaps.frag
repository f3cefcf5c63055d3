// Buffers are numbered without gaps: two passes exist, 0 and 1, and that of BUFFER_2 does not.
uniform sampler2D u_buffer0, u_buffer1;
uniform vec2 u_resolution;
varying vec2 v_texcoord;

void main() {
#if defined(BUFFER_0)
    gl_FragColor = vec4(v_texcoord, 0.25, 1.0);
#elif defined(BUFFER_2)
    gl_FragColor = vec4(1.0, 0.0, 0.0, 1.0);
#else
    gl_FragColor = vec4(texture2D(u_buffer0, v_texcoord).xy, texture2D(u_buffer1, v_texcoord).z * 0.5 + 0.25, 1.0);
#endif
}
