// mode: classic
// mouse: 9,13
precision highp float;
uniform vec2 resolution;
uniform vec2 mouse;
uniform float frame;
uniform float sound;
uniform sampler2D backbuffer;

void main() {
    vec2 at = gl_FragCoord.xy / resolution;
    vec4 before = texture2D(backbuffer, at);
    float sum = frame < 1.5 ? 0.0 : before.a;
    gl_FragColor = vec4(mouse * at, sum / 50.0 + sound, sum + frame);
}
