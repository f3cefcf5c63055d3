// Each file is inserted once.
#include "data/shapes.glsl"
#include "data/shapes.glsl"
uniform vec2 u_resolution;

void main() {
    vec2 at = 2.0 * gl_FragCoord.xy / u_resolution - 1.0;
    gl_FragColor = vec4(max(circle(at, 1.5), 0.0), 0.5 + 0.5 * at, 1.0);
}
