// The sky of a clear day: A. J. Preetham, P. Shirley, B. Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999.
// Luminance in kcd/m^2, times `EXPOSED`; chromaticity as they give it.

#iUniform float sunHeight = 24.0 in { 2.0, 80.0 }      // degrees above the horizon
#iUniform float turbidity = 2.6 in { 2.0, 8.0 }        // 2 is clear air, 8 is haze
#iUniform float clouds = 0.45 in { 0.0, 1.0 }
#iUniform int samples = 16 in { 1, 64 }                 // directions of a reflection

const float PI = 3.14159265;
const float EXPOSED = 0.05;

// The side of a face of the cubemap, in texels.
const float SIDE = 1024.0;

// The share of light that the ground reflects on average.
const vec3 GROUND = vec3(0.40, 0.36, 0.31);

vec3 sunDirection() {
    float height = radians(sunHeight);
    return vec3(cos(height) * 0.8, sin(height), -cos(height) * 0.6);
}

// F of Perez: five numbers by the angles from the zenith (its cosine) and from the sun.
float perez(float a, float b, float c, float d, float e, float cosZenith, float sunAngle) {
    float cosSun = cos(sunAngle);
    return (1.0 + a * exp(b / cosZenith)) * (1.0 + c * exp(d * sunAngle) + e * cosSun * cosSun);
}

float zenithChromaticity(vec4 cubed, vec4 squared, vec4 plain, float t) {
    float s = radians(90.0 - sunHeight);
    vec4 powers = vec4(s * s * s, s * s, s, 1.0);
    return t * t * dot(powers, cubed) + t * dot(powers, squared) + dot(powers, plain);
}

// Radiance of the clear sky from a direction above the horizon, in linear sRGB.
vec3 clearSky(vec3 direction) {
    vec3 sun = sunDirection();
    float t = turbidity, s = radians(90.0 - sunHeight);
    float up = max(direction.y, 0.01);
    float angle = acos(clamp(dot(direction, sun), -1.0, 1.0));
    float chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * s);
    float zenith = (4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192;
    float luminance = zenith
        * perez(0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703, up, angle)
        / perez(0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703, 1.0, s);
    float x = zenithChromaticity(vec4(0.00166, -0.00375, 0.00209, 0.0), vec4(-0.02903, 0.06377, -0.03202, 0.00394),
                                 vec4(0.11693, -0.21196, 0.06052, 0.25886), t)
        * perez(-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452, up, angle)
        / perez(-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
                -0.0033 * t + 0.0452, 1.0, s);
    float y = zenithChromaticity(vec4(0.00275, -0.00610, 0.00317, 0.0), vec4(-0.04214, 0.08970, -0.04153, 0.00516),
                                 vec4(0.15346, -0.26756, 0.06670, 0.26688), t)
        * perez(-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529, up, angle)
        / perez(-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
                -0.0109 * t + 0.0529, 1.0, s);
    vec3 xyz = max(luminance, 0.0) * EXPOSED * vec3(x / y, 1.0, (1.0 - x - y) / y);
    // IEC 61966-2-1: CIE XYZ to linear sRGB.
    return max(mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570) * xyz, 0.0);
}

uint hash(uvec3 p) {
    // M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020: pcg3d, its first number.
    p = p * 1664525u + 1013904223u;
    p.x += p.y * p.z;
    p.y += p.z * p.x;
    p.z += p.x * p.y;
    p ^= p >> 16u;
    return p.x + p.y * p.z;
}

float corner(ivec3 cell) {
    return float(hash(uvec3(cell)) >> 8u) / 16777216.0;
}

float noise(vec3 p) {
    vec3 base = floor(p), f = p - base;
    ivec3 c = ivec3(base);
    f = f * f * (3.0 - 2.0 * f);
    vec4 low = vec4(corner(c), corner(c + ivec3(1, 0, 0)), corner(c + ivec3(0, 1, 0)), corner(c + ivec3(1, 1, 0)));
    vec4 high = vec4(corner(c + ivec3(0, 0, 1)), corner(c + ivec3(1, 0, 1)), corner(c + ivec3(0, 1, 1)),
                     corner(c + ivec3(1, 1, 1)));
    vec4 level = mix(low, high, f.z);
    vec2 row = mix(level.xz, level.yw, f.x);
    return mix(row.x, row.y, f.y);
}

// GGX (B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007), alpha = roughness^2.
// A half vector about the z axis by two numbers in 0 to 1.
vec3 halfVector(vec2 u, float alpha) {
    float cosTheta = sqrt((1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x));
    float sinTheta = sqrt(max(1.0 - cosTheta * cosTheta, 0.0));
    return vec3(sinTheta * cos(2.0 * PI * u.y), sinTheta * sin(2.0 * PI * u.y), cosTheta);
}

float ggx(float cosTheta, float alpha) {
    float a2 = alpha * alpha, d = cosTheta * cosTheta * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}
