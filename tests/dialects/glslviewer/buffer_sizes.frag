// Buffers of their own sizes, and u_resolution in them.
uniform sampler2D u_buffer0; // 0.5
uniform sampler2D u_buffer1; // 8x4
uniform vec2 u_resolution;
varying vec2 v_texcoord;

void main() {
#ifdef BUFFER_0
    gl_FragColor = vec4(gl_FragCoord.xy / u_resolution, u_resolution.x / 32.0, 1.0);
#elif defined(BUFFER_1)
    gl_FragColor = vec4(u_resolution / 16.0, texture2D(u_buffer0, v_texcoord).x, 1.0);
#else
    vec4 half_size = texture2D(u_buffer0, v_texcoord);
    vec4 fixed_size = texture2D(u_buffer1, v_texcoord);
    gl_FragColor = v_texcoord.x < 0.5 ? half_size : fixed_size;
    if (v_texcoord.y > 0.8) gl_FragColor = vec4(u_resolution / 64.0, v_texcoord.x, 1.0);
#endif
}
