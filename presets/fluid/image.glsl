// Paint lit as a relief: its thickness is a height field, and central differences of it are the normal.
// Channel 0 is Buffer D. Shading: J. Blinn, "Models of Light Reflection", SIGGRAPH 1977.

const vec3 PAPER = vec3(0.90, 0.87, 0.81);
const vec3 SUN = normalize(vec3(-0.50, 0.62, 0.60));

vec4 paint(ivec2 p) {
    ivec2 size = ivec2(iResolution.xy);
    if (size.y < 2) return vec4(0.0); // the one row there is holds the mouse
    return texelFetch(iChannel0, nearestCell(p, size), 0);
}

float height(ivec2 p) {
    return 1.0 - exp(-2.0 * paint(p).a);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    float scale = iResolution.y / 270.0; // as much relief as on a canvas 270 pixels high, whatever the size is

    vec2 slope = vec2(height(p - ivec2(1, 0)) - height(p + ivec2(1, 0)),
                      height(p - ivec2(0, 1)) - height(p + ivec2(0, 1)));
    vec3 n = normalize(vec3(relief * scale * slope, 1.0));
    vec3 eye = normalize(vec3(-uv, 2.0));

    // Thick paint on the side of the sun throws its shadow here.
    ivec2 towardsSun = ivec2(round(7.0 * scale * SUN.xy));
    float shadow = max(height(p + towardsSun) + 0.6 * height(p + towardsSun / 2) - 1.0 * height(p), 0.0);

    vec4 c = paint(p);
    vec3 pigment = c.rgb / max(c.a, 1e-4);
    // Light goes through the paint, off the paper and back: thin paint is a glaze, thick paint shows its own colour.
    vec3 ground = PAPER * (1.0 - 0.35 * min(dot(uv, uv), 1.0)) * (1.0 - 0.32 * shadow);
    vec3 shown = mix(ground * exp(-2.2 * c.a * (1.0 - pigment)), pigment, 1.0 - exp(-1.6 * c.a));
    shown *= 0.62 + 0.48 * max(dot(n, SUN), 0.0) / SUN.z;
    float gloss = 1.0 - exp(-5.0 * c.a);
    shown += gloss * 0.55 * pow(max(dot(n, normalize(SUN + eye)), 0.0), 70.0);
    shown = pow(shown, vec3(0.8));

    // Hatched while the sliders ask for what the method cannot do.
    if (beyondTheMethod() && fragCoord.y < 0.03 * iResolution.y) {
        shown = mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y ? vec3(0.85, 0.1, 0.1)
            : shown;
    }
    if (view != 0) shown = viewOf(CELL(iChannel1, p, ivec2(iResolution.xy)));
    fragColor = vec4(shown, 1.0);
}
