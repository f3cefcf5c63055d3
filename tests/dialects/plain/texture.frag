#version 300 es
precision highp float;
// A picture that is not a power of two: its lowest row is at 0, and its edges continue.
uniform sampler2D picture; // data/odd.png
uniform vec2 pictureResolution;
uniform vec2 uResolution;
out vec4 color;

void main() {
    vec2 at = gl_FragCoord.xy / uResolution;
    color = texture(picture, at * 1.5 - 0.25);
    if (at.y > 0.85) color = vec4(pictureResolution / 8.0, at.x, 1.0);
}
