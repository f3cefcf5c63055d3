// mode: classic300 mrt
precision highp float;
uniform vec2 resolution;
uniform float frame;
uniform float sound;
uniform sampler2D backbuffer0;
uniform sampler2D backbuffer1;
layout(location = 0) out vec4 outColor0;
layout(location = 1) out vec4 outColor1;

void main() {
    vec2 at = gl_FragCoord.xy / resolution;
    vec4 one = texture(backbuffer0, at), two = texture(backbuffer1, at);
    if (frame < 1.5) one = two = vec4(0.0);
    outColor0 = vec4(two.x, one.y + 0.125 * at.x, two.z * 0.1 + sound, 1.0);
    outColor1 = vec4(at.y, 0.0, two.z + 1.0, 1.0);
}
