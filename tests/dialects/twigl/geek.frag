// mode: geek
// mouse: 20,5
precision highp float;
uniform vec2 r;
uniform vec2 m;
uniform float t;
uniform float f;
uniform float s;

void main() {
    vec2 p = gl_FragCoord.xy / r;
    gl_FragColor = vec4(p.x < 0.5 ? vec3(m, p.y) : vec3(t * 5.0, f / 16.0 + s, p.y), 1.0);
}
