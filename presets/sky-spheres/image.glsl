// Reflections by filtered importance sampling (J. Krivanek, M. Colbert, "Real-time Shading with Filtered Importance
// Sampling", EGSR 2008): few directions drawn by the lobe, each reading the mip level whose texels cover its share of it.

#include "lobe.glsl"

vec3 environment(vec3 direction, float level) {
    return textureLod(iChannel0, direction, level).rgb;
}

// Light that a GGX lobe about a normal sends to an eye: with one direction a single read by the mirror's.
vec3 reflected(vec3 normal, vec3 eye, float roughness) {
    float alpha = roughness * roughness;
    if (alpha < 1e-3) return environment(reflect(-eye, normal), 0.0);
    vec3 side = normalize(abs(normal.y) < 0.99 ? cross(normal, vec3(0.0, 1.0, 0.0)) : vec3(1.0, 0.0, 0.0));
    mat3 frame = mat3(side, cross(normal, side), normal);
    float texel = 4.0 * PI / (6.0 * SIDE * SIDE);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int i = 0; i < samples; i++) {
        vec3 h = frame * (samples == 1 ? vec3(0.0, 0.0, 1.0) : halfVector(hammersley(i, samples), alpha));
        vec3 light = reflect(-eye, h);
        float cosine = dot(normal, light);
        if (cosine <= 0.0) continue;
        float cosH = max(dot(normal, h), 1e-4), cosE = max(dot(eye, h), 1e-4);
        float density = ggx(cosH, alpha) * cosH / (4.0 * cosE);
        // One level more: the reads of neighbours overlap, as the paper advises.
        float level = 0.5 * log2(1.0 / (float(samples) * density * texel)) + 1.0;
        sum += cosine * environment(light, max(level, 0.0));
        weights += cosine;
    }
    return sum / max(weights, 1e-4);
}

// The share of light that a rough metal reflects (D. Lazarov, "Getting More Physical in Call of Duty: Black Ops II",
// SIGGRAPH 2013 course), with what bounces more than once between its facets (E. Turquin, "Practical multiple scattering
// compensation for microfacet models", 2019).
vec3 metal(vec3 colour, float roughness, float cosine) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * cosine)) * r.x + r.y;
    vec2 scaled = vec2(-1.04, 1.04) * a + r.zw;
    float once = scaled.x + scaled.y;
    return (colour * scaled.x + scaled.y) * (1.0 + colour * (1.0 / once - 1.0));
}

// Distance to a sphere, or -1.
float sphere(vec3 from, vec3 direction, vec3 centre, float radius) {
    vec3 to = from - centre;
    float b = dot(to, direction), c = dot(to, to) - radius * radius, d = b * b - c;
    return d < 0.0 ? -1.0 : -b - sqrt(d);
}

const int COUNT = 5;

vec3 centre(int i) {
    return vec3(2.4 * (float(i) - 2.0), 1.0, 0.0);
}

// How much of the sky a point of the ground sees past the spheres: a sphere of radius 1 above it hides a share of its
// hemisphere by the cosine (I. Quilez, "Sphere - ambient occlusion").
float open(vec3 at) {
    float seen = 1.0;
    for (int i = 0; i < COUNT; i++) {
        vec3 to = centre(i) - at;
        float distance2 = dot(to, to);
        seen *= 1.0 - max(to.y, 0.0) * inversesqrt(distance2) / distance2;
    }
    return seen;
}

// Whether a point sees the sun, with an edge that widens with the distance.
float sunlit(vec3 at) {
    float seen = 1.0;
    vec3 sun = sunDirection();
    for (int i = 0; i < COUNT; i++) {
        vec3 to = centre(i) - at;
        float along = dot(to, sun);
        if (along > 0.0) seen *= smoothstep(-0.03, 0.03, (length(to - along * sun) - 1.0) / along);
    }
    return seen;
}

vec3 shaded(vec3 from, vec3 direction) {
    float nearest = 1e9;
    int hit = -1;
    for (int i = 0; i < COUNT; i++) {
        float t = sphere(from, direction, centre(i), 1.0);
        if (t > 0.0 && t < nearest) {
            nearest = t;
            hit = i;
        }
    }
    float ground = direction.y < -1e-4 ? -from.y / direction.y : 1e9;
    if (hit >= 0 && nearest < ground) {
        vec3 at = from + nearest * direction, normal = normalize(at - centre(hit)), eye = -direction;
        float roughness = 0.2 * float(hit);
        vec3 colour = mix(vec3(0.95, 0.93, 0.88), vec3(1.0, 0.71, 0.29), float(hit) / float(COUNT - 1));
        return metal(colour, roughness, max(dot(normal, eye), 0.0)) * reflected(normal, eye, roughness);
    }
    if (ground < 1e8) {
        vec3 at = from + ground * direction;
        // A checkerboard, averaged over the pixel's width (I. Quilez, "Filtering the checkerboard pattern").
        vec2 width = max(abs(dFdx(at.xz)), abs(dFdy(at.xz))) + 1e-3;
        vec2 p = at.xz * 0.5;
        width *= 0.5;
        vec2 i = (abs(fract((p - 0.5 * width) * 0.5) - 0.5) - abs(fract((p + 0.5 * width) * 0.5) - 0.5)) / width;
        float tile = 0.5 - 2.0 * i.x * i.y;
        vec3 colour = GROUND * mix(0.5, 1.5, clamp(tile, 0.0, 1.0));
        // What the ground sends downward in the cubemap, half of it from the sun.
        vec3 light = environment(vec3(0.0, -1.0, 0.0), 4.0) / GROUND * (0.5 * open(at) + 0.5 * sunlit(at));
        vec3 horizon = environment(normalize(vec3(direction.x, 0.02, direction.z)), 3.0);
        return mix(horizon, colour * light, exp(-0.035 * ground));
    }
    return environment(direction, 0.0);
}

// Fits light into what a screen can show (K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016).
vec3 filmic(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 mouse = iMouse.x + iMouse.y > 0.0 ? iMouse.xy / iResolution.xy - 0.5 : vec2(0.03, -0.02);
    float turn = 4.0 * mouse.x + 0.05 * sin(0.2 * iTime), lift = 0.28 - 0.9 * mouse.y;
    vec3 eye = vec3(0.0, 1.0, 0.0) + 9.5 * vec3(sin(turn) * cos(lift), max(sin(lift), -0.05), cos(turn) * cos(lift));
    vec3 forward = normalize(vec3(0.0, 1.0, 0.0) - eye), right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    vec3 direction = normalize(p.x * right + p.y * cross(right, forward) + 2.3 * forward);
    fragColor = vec4(pow(filmic(shaded(eye, direction)), vec3(1.0 / 2.2)), 1.0);
}
