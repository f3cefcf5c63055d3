// mode: geek300
precision highp float;
uniform vec2 r;
uniform float t;
out vec4 o;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy) / 4;
    o = vec4(float(cell.x & 3) / 4.0, gl_FragCoord.y / r.y, t, 1.0);
}
