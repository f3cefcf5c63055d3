// Phong's light on the surface: B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6), 1975: ambient,
// diffuse by n . l, specular by (r . v)^shininess, for two lamps. Channel 0 is the normal and the height.

vec3 phong(vec3 n, vec3 toEye, vec3 toLamp, vec3 lamp, vec3 body) {
    float facing = max(dot(n, toLamp), 0.0);
    float mirrored = max(dot(reflect(-toLamp, n), toEye), 0.0);
    return lamp * (body * facing + 0.9 * pow(mirrored, shininess) * step(0.0, dot(n, toLamp)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec4 surface = texelFetch(iChannel0, ivec2(fragCoord), 0);
    vec2 uv = (fragCoord - 0.5 * iResolution.xy) / iResolution.y;
    vec3 n = surface.xyz;
    vec3 toEye = normalize(vec3(-0.35 * clamp(uv, -2.0, 2.0), 1.0));

    // Hills are warm, hollows deep.
    float h = surface.a / (0.25 + abs(surface.a));
    vec3 body = mix(liquid, warm, smoothstep(-0.1, 0.9, h));
    body = mix(body, 0.25 * liquid.zyx + 0.02, smoothstep(0.1, -0.9, h));

    vec3 shown = 0.10 * body;
    shown += phong(n, toEye, normalize(vec3(-0.75, 0.75, 0.65)), vec3(1.05, 0.98, 0.90), body);
    shown += phong(n, toEye, normalize(vec3(1.0, -0.5, 0.45)), vec3(0.25, 0.38, 0.60), body);
    // A sky above, mirrored the more the flatter one looks at it (C. Schlick, 1994).
    vec3 r = reflect(-toEye, n);
    vec3 sky = mix(vec3(0.02, 0.03, 0.06), vec3(0.50, 0.62, 0.78), smoothstep(0.1, 0.9, r.y * 0.6 + 0.4));
    shown += sky * (0.04 + 0.96 * pow(1.0 - max(dot(n, toEye), 0.0), 5.0));
    shown = pow(shown, vec3(1.0 / 1.9)) * (1.0 - 0.25 * min(dot(uv, uv), 1.0));

    if (beyondTheMethod() && fragCoord.y < 0.03 * iResolution.y && mod(fragCoord.x + fragCoord.y, 0.06 * iResolution.y) < 0.03 * iResolution.y) {
        shown = vec3(0.85, 0.1, 0.1);
    }
    if (view != 0) shown = viewOf(CELL(iChannel1, ivec2(fragCoord), ivec2(iResolution.xy)));
    fragColor = vec4(shown, 1.0);
}
