// The drawing. Channel 0 is the G-buffer, channel 1 the lines.

#iUniform float wobble = 1.0 in { 0.0, 4.0 }   // how unsteady the hand is
#iUniform float redraws = 6.0 in { 0.0, 24.0 } // drawings a second
#iUniform float hatching = 1.0 in { 0.0, 2.0 }
#iUniform float wash = 0.75 in { 0.0, 1.0 }    // watercolour under the lines
#iUniform color3 ink = color3(0.10, 0.11, 0.19)

const vec3 PAPER = vec3(0.955, 0.930, 0.875);

float hash(vec2 p) {
    vec3 q = fract(vec3(p.xyx) * 0.1031);
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}

float noise(vec2 p) {
    vec2 i = floor(p), f = p - i;
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1.0, 0.0)), f.x), mix(hash(i + vec2(0.0, 1.0)), hash(i + 1.0), f.x), f.y);
}

float lineAt(vec2 pixel) {
    return max(textureLod(iChannel1, pixel / iResolution.xy, 0.0).x,
               textureLod(iChannel1, pixel / iResolution.xy, 0.0).y);
}

vec3 pigment(int material) {
    return material == 2 ? vec3(0.26, 0.50, 0.60) : material == 3 ? vec3(0.86, 0.62, 0.24)
         : material == 4 ? vec3(0.78, 0.27, 0.22) : material == 5 ? vec3(0.45, 0.56, 0.32)
         : material == 1 ? vec3(0.93, 0.84, 0.70) : vec3(0.965, 0.945, 0.90);
}

// One layer of strokes: parallel lines, a little bent, that thin out as the light grows.
float strokes(vec2 p, float angle, float dark) {
    vec2 q = vec2(cos(angle) * p.x + sin(angle) * p.y, cos(angle) * p.y - sin(angle) * p.x);
    q.y += 1.3 * noise(q * vec2(0.035, 0.1) + angle);
    float across = abs(fract(q.y / 5.0) - 0.5) * 2.0, pressure = 0.55 + 0.75 * noise(q * vec2(0.05, 0.4) + 7.0);
    return smoothstep(0.25, 0.55, dark * pressure * 1.15 - across * 0.75);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float scale = max(iResolution.y / 360.0, 0.5); // everything is drawn as on a sheet 360 high
    vec2 p = fragCoord / scale;
    float sheet = 13.7 * floor(redraws * iTime);
    vec2 shake = vec2(noise(p * 0.045 + sheet), noise(p * 0.045 + sheet + 50.0)) - 0.5;
    vec2 tremble = vec2(noise(p * 0.21 + sheet + 90.0), noise(p * 0.21 + sheet + 130.0)) - 0.5;
    vec2 hand = wobble * scale * (4.0 * shake + 1.0 * tremble);
    float grain = noise(p * 0.9) * 0.5 + noise(p * 0.35) * 0.5;

    vec4 g = texelFetch(iChannel0, clamp(ivec2(fragCoord + 0.6 * hand), ivec2(0), ivec2(iResolution.xy) - 1), 0);
    int material = int(g.w);
    float light = fract(g.w);
    vec3 colour = PAPER * (0.965 + 0.05 * grain);

    // The wash pools at the bottom of a tone and leaves the brightest places bare.
    vec3 paint = pigment(material);
    float tone = smoothstep(0.95, 0.25, light + 0.12 * (grain - 0.5));
    paint = mix(vec3(1.0), paint, 0.55 + 0.45 * tone) * mix(1.0, 0.72, tone * float(material > 0));
    colour *= mix(vec3(1.0), paint, wash);

    if (material > 0) {
        float dark = hatching * (1.0 - light);
        float hatch = strokes(p + 0.5 * shake, 0.75, 1.35 * dark - 0.25);
        hatch = max(hatch, strokes(p + 0.5 * shake, 2.25, 1.55 * dark - 0.75));
        hatch = max(hatch, strokes(p, 1.45, 1.7 * dark - 1.15));
        colour = mix(colour, ink, 0.62 * hatch * (0.7 + 0.3 * grain));
    }
    // Two passes of the pencil, the second by a hand that has moved on.
    float first = lineAt(fragCoord + hand), second = lineAt(fragCoord - 0.8 * hand.yx);
    float pencil = (0.90 * first + 0.55 * second * (1.0 - first)) * (0.72 + 0.45 * grain);
    colour = mix(colour, ink, clamp(pencil, 0.0, 1.0));
    vec2 uv = fragCoord / iResolution.xy - 0.5;
    fragColor = vec4(colour * (1.0 - 0.22 * dot(uv, uv)), 1.0);
}
