// Buffers are cleared before each frame: pixels that are discarded are 0.
uniform sampler2D u_buffer0;
uniform sampler2D u_doubleBuffer0;
uniform vec2 u_resolution;
uniform int u_frame;
varying vec2 v_texcoord;

void main() {
#if defined(BUFFER_0)
    if (v_texcoord.x > 0.5 && mod(float(u_frame), 4.0) < 1.5) discard;
    gl_FragColor = vec4(v_texcoord, 0.5, 1.0);
#elif defined(DOUBLE_BUFFER_0)
    if (v_texcoord.y > 0.5 && mod(float(u_frame), 4.0) < 1.5) discard;
    gl_FragColor = vec4(0.25, 0.5, v_texcoord.x, 1.0);
#else
    gl_FragColor = vec4(0.5 * texture2D(u_buffer0, v_texcoord).rgb + 0.5 * texture2D(u_doubleBuffer0, v_texcoord).rgb, 1.0);
#endif
}
