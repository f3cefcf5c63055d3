// The blurred cards, and below each the response to one texel: its texels magnified, its profile along the middle row
// as a curve, and as dots what a Gaussian of the same sigma has there. Channel 0 is Buffer C.

vec3 ink(int method) {
    return isTaps(method) ? vec3(1.00, 0.55, 0.20) : method != MIP ? vec3(0.30, 0.80, 0.95) : vec3(0.75, 0.55, 1.00);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord), size = ivec2(iResolution.xy);
    ivec3 panel = panelOf(p.x, size.x);
    vec2 middle = vec2(float(panel.x) + 0.5 * float(panel.y), 0.125 * iResolution.y);
    vec3 light = texelFetch(iChannel0, p, 0).rgb;

    float reach = float(2 * REACH + 3); // texels shown across
    float zoom = min(0.225 * iResolution.y, 0.45 * float(panel.y)) / reach;
    vec2 q = fragCoord - middle;
    if (fragCoord.y < 0.25 * iResolution.y) {
        ivec2 impulse = impulseOf(panel, size.y);
        light = vec3(0.010, 0.012, 0.020);
        vec2 graph = q - vec2(0.5 * reach * zoom, 0.0);
        vec2 square = q + vec2(0.52 * reach * zoom, 0.0);
        float peak = 1.0 / (6.2832 * sigma * sigma);
        if (max(abs(square.x), abs(square.y)) < 0.5 * reach * zoom) {
            ivec2 from = impulse + ivec2(floor(square / zoom + 0.5));
            light = ink(panel.z) * texelFetch(iChannel0, clamp(from, ivec2(0), size - 1), 0).rgb / peak;
            vec2 cell = abs(fract(square / zoom + 0.5) - 0.5);
            light += max(cell.x, cell.y) > 0.5 - 0.5 / max(zoom, 4.0) ? 0.012 : 0.0;
        } else if (abs(graph.x) < 0.5 * reach * zoom && abs(q.y) < 0.5 * reach * zoom) {
            float x = floor(graph.x / zoom + 0.5);
            ivec2 from = clamp(impulse + ivec2(int(x), 0), ivec2(0), size - 1);
            float value = texelFetch(iChannel0, from, 0).g / peak, y = q.y / (reach * zoom) + 0.5;
            light = ink(panel.z) * (y < 0.85 * value ? 0.35 : 0.015);
            vec2 dot_ = vec2(graph.x - x * zoom, (y - 0.85 * exp(-0.5 * x * x / (sigma * sigma))) * reach * zoom);
            light = mix(light, vec3(1.0), clamp(0.5 + 0.14 * zoom - length(dot_), 0.0, 1.0));
        }
    }
    if (variant == 0 && panel.x > 0 && p.x == panel.x) light = vec3(0.10, 0.12, 0.16);
    fragColor = vec4(sqrt(max(light, 0.0)), 1.0);
}
