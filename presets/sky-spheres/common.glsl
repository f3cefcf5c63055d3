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
float perez(vec4 abcd, float e, float cosZenith, float sunAngle) {
    float cosSun = cos(sunAngle);
    return (1.0 + abcd.x * exp(abcd.y / cosZenith)) * (1.0 + abcd.z * exp(abcd.w * sunAngle) + e * cosSun * cosSun);
}

// What Buffer A holds of the sky: of luminance and of the chromaticities x and y each a, b, c and d of Perez, then e and the
// value at the zenith over F there.
struct Sky {
    vec4 abcd[3];
    vec2 rest[3];
};

// Radiance of the clear sky from a direction above the horizon, in linear sRGB.
vec3 clearSky(Sky sky, vec3 direction) {
    float up = max(direction.y, 0.01), angle = acos(clamp(dot(direction, sunDirection()), -1.0, 1.0));
    vec3 yxy;
    for (int i = 0; i < 3; i++) yxy[i] = sky.rest[i].y * perez(sky.abcd[i], sky.rest[i].x, up, angle);
    vec3 xyz = max(yxy.x, 0.0) * EXPOSED * vec3(yxy.y / yxy.z, 1.0, (1.0 - yxy.y - yxy.z) / yxy.z);
    // IEC 61966-2-1: CIE XYZ to linear sRGB.
    return max(mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570) * xyz, 0.0);
}

// Light that a cloud sends: of the sky, and of the sun that shines through it.
vec3 cloudLight(Sky sky, vec3 direction) {
    float towardsSun = max(dot(direction, sunDirection()), 0.0);
    return clearSky(sky, vec3(0.0, 1.0, 0.0)) * 1.6 + vec3(0.42, 0.36, 0.3) * (0.35 + pow(towardsSun, 6.0));
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
