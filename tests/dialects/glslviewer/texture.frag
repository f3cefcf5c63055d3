// A picture is upside down in memory, so that v = 0 is its lowest row; it repeats, and has the uniform of its size.
uniform sampler2D u_tex0; // data/four.png
uniform vec2 u_tex0Resolution;
varying vec2 v_texcoord;

void main() {
    gl_FragColor = texture2D(u_tex0, v_texcoord * 1.75 - 0.25);
    if (v_texcoord.y > 0.85) gl_FragColor = vec4(u_tex0Resolution / 8.0, v_texcoord.x, 1.0);
}
