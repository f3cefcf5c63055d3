// mode: classic
precision highp float;
uniform vec2 resolution;
uniform vec2 mouse;
uniform float time;
uniform float frame;
uniform float sound;

void main() {
    vec2 at = gl_FragCoord.xy / resolution;
    vec3 color = at.x < 0.5 ? vec3(time * 5.0, frame / 16.0, at.y) : vec3(resolution / 64.0, sound + 0.25 + 0.5 * at.y);
    gl_FragColor = vec4(color, 1.0);
}
