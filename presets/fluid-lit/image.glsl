// A lacquered liquid in a studio. Phong's light on the surface (B. T. Phong, "Illumination for Computer Generated
// Pictures", CACM 18(6), 1975): diffuse by n . l, specular by (r . v)^shininess, for two lamps; and two soft boxes
// mirrored in it, as much as Schlick's approximation says (C. Schlick, "An Inexpensive BRDF Model for Physically-based
// Rendering", Eurographics 1994). Channel 0 is the normal and the height, channel 1 the fluid.

vec3 phong(vec3 n, vec3 toEye, vec3 toLamp, vec3 lamp, vec3 body) {
    float facing = max(dot(n, toLamp), 0.0);
    float mirrored = max(dot(reflect(-toLamp, n), toEye), 0.0);
    return lamp * (body * facing + 0.5 * pow(mirrored, shininess) * step(0.0, dot(n, toLamp)));
}

// 1 inside a rectangle with soft edges, on a ceiling at height 1.
float softBox(vec3 r, vec2 centre, vec2 half_size, float turn) {
    vec2 at = r.xy / max(r.z, 0.05) - centre;
    at = abs(mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * at) - half_size;
    return (1.0 - smoothstep(-0.06, 0.10, at.x)) * (1.0 - smoothstep(-0.06, 0.10, at.y)) * step(0.0, r.z);
}

vec3 studio(vec3 r) {
    vec3 room = mix(vec3(0.010, 0.014, 0.028), vec3(0.085, 0.120, 0.190), smoothstep(-0.5, 0.8, r.y));
    room += vec3(1.00, 0.93, 0.82) * softBox(r, vec2(-0.75, 0.80), vec2(0.42, 0.22), 0.7);
    room += vec3(0.30, 0.52, 0.85) * softBox(r, vec2(1.05, -0.45), vec2(0.16, 0.70), 0.2);
    return room;
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 surface = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 n = surface.xyz;
    vec3 toEye = normalize(vec3(-0.35 * clamp(uv, -2.0, 2.0), 1.0));

    // Hills are warm, hollows deep, and what is between has the liquid's own colour.
    float h = surface.a / (0.12 + abs(surface.a));
    vec3 body = mix(liquid, warm, smoothstep(0.52, 0.88, h));
    body = mix(body, deep, smoothstep(0.52, 0.88, -h));

    vec3 shown = 0.30 * body;
    shown += phong(n, toEye, normalize(vec3(-0.70, 0.75, 0.75)), vec3(1.00, 0.95, 0.88), body);
    shown += phong(n, toEye, normalize(vec3(0.95, -0.45, 0.50)), vec3(0.18, 0.30, 0.52), body);
    float fresnel = 0.10 + 0.90 * pow(1.0 - clamp(dot(n, toEye), 0.0, 1.0), 5.0);
    shown += fresnel * 3.0 * studio(reflect(-toEye, n));
    shown *= 1.0 - 0.35 * min(dot(uv, uv), 1.0);
    shown = pow(1.0 - exp(-1.5 * shown), vec3(1.0 / 1.9));

    if (beyondTheMethod() && fragCoord.y < 0.03 * iResolution.y
        && mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y) {
        shown = vec3(0.85, 0.1, 0.1);
    }
    if (view != 0) shown = viewOf(CELL(iChannel1, ivec2(fragCoord), ivec2(iResolution.xy)));
    fragColor = vec4(shown, 1.0);
}
