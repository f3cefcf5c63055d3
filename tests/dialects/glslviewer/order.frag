// Which frame of the other buffers a pass reads: the frame that the last pass to write them was in.
uniform sampler2D u_buffer0, u_buffer1, u_doubleBuffer0, u_doubleBuffer1;
uniform int u_frame;
varying vec2 v_texcoord;

void main() {
    float now = float(u_frame) / 16.0;
    vec4 a = texture2D(u_buffer0, v_texcoord), b = texture2D(u_buffer1, v_texcoord);
    vec4 c = texture2D(u_doubleBuffer0, v_texcoord), d = texture2D(u_doubleBuffer1, v_texcoord);
#if defined(BUFFER_0)
    gl_FragColor = vec4(now, b.x, c.x, d.x);
#elif defined(BUFFER_1)
    gl_FragColor = vec4(now, a.x, c.x, d.x);
#elif defined(DOUBLE_BUFFER_0)
    gl_FragColor = vec4(now, a.x, c.x, d.x);
#elif defined(DOUBLE_BUFFER_1)
    gl_FragColor = vec4(now, b.x, c.x, d.x);
#else
    vec4 shown = v_texcoord.x < 0.25 ? a : v_texcoord.x < 0.5 ? b : v_texcoord.x < 0.75 ? c : d;
    gl_FragColor = vec4(v_texcoord.y < 0.5 ? shown.xyz : shown.www, 1.0);
#endif
}
