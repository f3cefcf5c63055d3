// Textures of other names, with their sizes.
uniform sampler2D u_logo; // data/four.png
uniform vec2 u_logoResolution;
uniform vec2 u_resolution;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
    gl_FragColor = vec4(texture2D(u_logo, at).rg, u_logoResolution.y / 8.0, 1.0);
}
