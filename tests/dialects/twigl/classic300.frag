// mode: classic300
precision highp float;
uniform vec2 resolution;
uniform float time;
uniform float frame;
uniform float sound;
out vec4 outColor;

void main() {
    vec2 at = gl_FragCoord.xy / resolution;
    uint count = uint(frame + 0.5);
    outColor = vec4(float(count % 4u) / 4.0, at.x * time * 8.0, at.y + sound, 1.0);
}
