// mode: geek300
precision highp float;
uniform vec2 r;
uniform float f;
uniform sampler2D b;
out vec4 o;

void main() {
    vec2 p = gl_FragCoord.xy / r;
    vec4 before = f < 1.5 ? vec4(0.0) : texelFetch(b, ivec2(gl_FragCoord.xy), 0);
    o = vec4(before.r + p.x * 0.1, before.g * 0.5 + p.y * 0.5, before.b + 0.0005, 1.0);
    if (f > 7.5) o.b *= 100.0;
}
