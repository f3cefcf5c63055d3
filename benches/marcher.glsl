// A ray marcher of some 500 lines: an arcade of pillars, a fountain and what stands about it, with soft shadows,
// ambient occlusion, six materials, fog and a sky. For benches/walk.rs.

const float FAR = 40.0;
const float NEAR_ENOUGH = 0.001;
const vec3 SUN = vec3(0.48, 0.62, -0.62);

float sphere(vec3 p, float r) {
    return length(p) - r;
}

float box(vec3 p, vec3 size) {
    vec3 q = abs(p) - size;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

float round_box(vec3 p, vec3 size, float r) {
    return box(p, size - r) - r;
}

float torus(vec3 p, vec2 radii) {
    vec2 q = vec2(length(p.xz) - radii.x, p.y);
    return length(q) - radii.y;
}

float cylinder(vec3 p, float r, float h) {
    vec2 d = abs(vec2(length(p.xz), p.y)) - vec2(r, h);
    return min(max(d.x, d.y), 0.0) + length(max(d, 0.0));
}

float capsule(vec3 p, vec3 a, vec3 b, float r) {
    vec3 pa = p - a;
    vec3 ba = b - a;
    float h = clamp(dot(pa, ba) / dot(ba, ba), 0.0, 1.0);
    return length(pa - ba * h) - r;
}

float cone(vec3 p, float h, float wide, float narrow) {
    float r = mix(wide, narrow, clamp(0.5 + 0.5 * p.y / h, 0.0, 1.0));
    float side = (length(p.xz) - r) * 0.8;
    return max(side, abs(p.y) - h);
}

float prism(vec3 p, vec2 h) {
    vec3 q = abs(p);
    return max(q.z - h.y, max(q.x * 0.866025 + p.y * 0.5, -p.y) - h.x * 0.5);
}

float join(float a, float b, float k) {
    float h = clamp(0.5 + 0.5 * (b - a) / k, 0.0, 1.0);
    return mix(b, a, h) - k * h * (1.0 - h);
}

float carve(float a, float b, float k) {
    return -join(-a, b, k);
}

vec2 nearer(vec2 a, vec2 b) {
    return a.x < b.x ? a : b;
}

mat2 turned(float angle) {
    float c = cos(angle);
    float s = sin(angle);
    return mat2(c, -s, s, c);
}

float random_of(vec2 p) {
    p = fract(p * vec2(0.3183099, 0.3678794));
    p += dot(p, p.yx + 19.19);
    return fract((p.x + p.y) * p.x);
}

float noise(vec2 p) {
    vec2 i = floor(p);
    vec2 f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    float bottom = mix(random_of(i), random_of(i + vec2(1.0, 0.0)), f.x);
    float top = mix(random_of(i + vec2(0.0, 1.0)), random_of(i + vec2(1.0, 1.0)), f.x);
    return mix(bottom, top, f.y);
}

float clouds(vec2 p) {
    float sum = 0.0;
    float weight = 0.5;
    for (int i = 0; i < 4; i++) {
        sum += weight * noise(p);
        p = turned(0.6) * p * 2.03;
        weight *= 0.5;
    }
    return sum;
}

float ground(vec3 p) {
    float slabs = 0.01 * smoothstep(0.46, 0.5, max(abs(fract(p.x) - 0.5), abs(fract(p.z) - 0.5)));
    return p.y + slabs;
}

float pillar(vec3 p) {
    float shaft = cone(p - vec3(0.0, 1.2, 0.0), 1.1, 0.17, 0.13);
    float flutes = 0.012 * cos(12.0 * atan(p.z, p.x));
    float d = shaft + flutes;
    d = join(d, round_box(p - vec3(0.0, 0.06, 0.0), vec3(0.26, 0.06, 0.26), 0.02), 0.03);
    d = join(d, torus(p - vec3(0.0, 0.18, 0.0), vec2(0.18, 0.05)), 0.02);
    d = join(d, torus(p - vec3(0.0, 2.2, 0.0), vec2(0.14, 0.05)), 0.02);
    return min(d, round_box(p - vec3(0.0, 2.36, 0.0), vec3(0.24, 0.07, 0.24), 0.02));
}

float arcade(vec3 p) {
    vec3 q = p;
    q.x = abs(q.x) - 2.6;
    float row = clamp(round(q.z / 1.6), -3.0, 3.0);
    q.z -= 1.6 * row;
    float d = pillar(q);
    vec3 beam = vec3(q.x, p.y - 2.6, p.z);
    d = min(d, round_box(beam, vec3(0.22, 0.18, 5.2), 0.03));
    vec3 arch = vec3(q.z, p.y - 2.36, q.x);
    return min(d, max(torus(arch.xzy, vec2(0.8, 0.09)), -arch.y));
}

float fountain(vec3 p) {
    float basin = cylinder(p - vec3(0.0, 0.2, 0.0), 1.1, 0.2) - 0.03;
    basin = carve(basin, cylinder(p - vec3(0.0, 0.38, 0.0), 0.95, 0.25), 0.05);
    float stem = cone(p - vec3(0.0, 0.6, 0.0), 0.5, 0.2, 0.08);
    float bowl = max(sphere(p - vec3(0.0, 1.5, 0.0), 0.55), p.y - 1.3);
    bowl = carve(bowl, sphere(p - vec3(0.0, 1.62, 0.0), 0.52), 0.03);
    return min(join(basin, stem, 0.1), join(stem, bowl, 0.1));
}

float water(vec3 p) {
    float wave = 0.01 * sin(14.0 * length(p.xz) - 4.0 * iTime) + 0.006 * sin(9.0 * p.x + 2.0 * iTime);
    return max(cylinder(p - vec3(0.0, 0.2, 0.0), 0.98, 0.14), p.y - 0.32 - wave);
}

float bench(vec3 p) {
    p -= vec3(1.75, 0.0, 0.0);
    p.xz = turned(0.0) * p.xz;
    float d = round_box(p - vec3(0.0, 0.3, 0.0), vec3(0.393, 0.04, 0.14), 0.02);
    vec3 q = vec3(abs(p.x) - 0.293, p.y - 0.14, abs(p.z) - 0.09);
    d = min(d, cylinder(q, 0.03, 0.14));
    return min(d, round_box(p - vec3(0.0, 0.5, 0.13), vec3(0.343, 0.1, 0.02), 0.01));
}

float urn(vec3 p) {
    p -= vec3(1.644, 0.0, 1.129);
    p.xz = turned(0.349) * p.xz;
    float d = sphere(p - vec3(0.0, 0.392, 0.0), 0.267);
    d = join(d, cone(p - vec3(0.0, 0.592, 0.0), 0.1, 0.185, 0.067), 0.06);
    d = join(d, torus(p - vec3(0.0, 0.692, 0.0), vec2(0.067, 0.02)), 0.02);
    return min(d, cylinder(p - vec3(0.0, 0.02, 0.0), 0.247, 0.02));
}

float lamp(vec3 p) {
    p -= vec3(1.341, 0.0, 2.121);
    p.xz = turned(0.698) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 1.152, 0.0), 0.025);
    d = join(d, capsule(p, vec3(0.0, 1.152, 0.0), vec3(0.2, 1.252, 0.0), 0.02), 0.03);
    d = min(d, sphere(p - vec3(0.22, 1.172, 0.0), 0.071));
    return join(d, cone(p - vec3(0.0, 0.05, 0.0), 0.05, 0.146, 0.03), 0.03);
}

float crate(vec3 p) {
    p -= vec3(0.875, 0.0, 2.858);
    p.xz = turned(1.047) * p.xz;
    float d = round_box(p - vec3(0.0, 0.263, 0.0), vec3(0.169, 0.263, 0.150), 0.01);
    vec3 q = abs(p - vec3(0.0, 0.263, 0.0));
    d = carve(d, box(q - vec3(0.169, 0.143, 0.0), vec3(0.02, 0.02, 1.0)), 0.01);
    return min(d, prism((p - vec3(0.0, 0.606, 0.0)).xyz, vec2(0.150, 0.1)));
}

float stool(vec3 p) {
    p -= vec3(0.304, 0.0, 3.25);
    p.xz = turned(1.396) * p.xz;
    float d = cylinder(p - vec3(0.0, 0.293, 0.0), 0.294, 0.293);
    d += 0.01 * sin(30.0 * p.y) * cos(8.0 * atan(p.z, p.x));
    d = carve(d, cylinder(p - vec3(0.0, 0.636, 0.0), 0.264, 0.1), 0.02);
    return min(d, torus(p - vec3(0.0, 0.586, 0.0), vec2(0.294, 0.015)));
}

float bollard(vec3 p) {
    p -= vec3(-0.304, 0.0, 3.25);
    p.xz = turned(1.745) * p.xz;
    float d = round_box(p - vec3(0.0, 0.15, 0.0), vec3(0.15, 0.15, 0.15), 0.02);
    d = join(d, capsule(p, vec3(0.0, 0.4, 0.0), vec3(0.084, 0.795, 0.0), 0.102), 0.08);
    d = join(d, sphere(p - vec3(0.084, 0.945, 0.0), 0.08), 0.04);
    return join(d, capsule(p, vec3(-0.16, 0.6, 0.05), vec3(0.16, 0.675, 0.05), 0.03), 0.05);
}

float planter(vec3 p) {
    p -= vec3(-0.875, 0.0, 2.858);
    p.xz = turned(2.094) * p.xz;
    float d = round_box(p - vec3(0.0, 0.3, 0.0), vec3(0.301, 0.04, 0.14), 0.02);
    vec3 q = vec3(abs(p.x) - 0.201, p.y - 0.14, abs(p.z) - 0.09);
    d = min(d, cylinder(q, 0.03, 0.14));
    return min(d, round_box(p - vec3(0.0, 0.5, 0.13), vec3(0.251, 0.1, 0.02), 0.01));
}

float statue(vec3 p) {
    p -= vec3(-1.341, 0.0, 2.121);
    p.xz = turned(2.443) * p.xz;
    float d = sphere(p - vec3(0.0, 0.356, 0.0), 0.179);
    d = join(d, cone(p - vec3(0.0, 0.556, 0.0), 0.1, 0.196, 0.053), 0.06);
    d = join(d, torus(p - vec3(0.0, 0.656, 0.0), vec2(0.053, 0.02)), 0.02);
    return min(d, cylinder(p - vec3(0.0, 0.02, 0.0), 0.159, 0.02));
}

float barrel(vec3 p) {
    p -= vec3(-1.644, 0.0, 1.129);
    p.xz = turned(2.793) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 1.205, 0.0), 0.025);
    d = join(d, capsule(p, vec3(0.0, 1.205, 0.0), vec3(0.2, 1.305, 0.0), 0.02), 0.03);
    d = min(d, sphere(p - vec3(0.22, 1.225, 0.0), 0.084));
    return join(d, cone(p - vec3(0.0, 0.05, 0.0), 0.05, 0.126, 0.03), 0.03);
}

float trough(vec3 p) {
    p -= vec3(-1.75, 0.0, 0.0);
    p.xz = turned(3.142) * p.xz;
    float d = round_box(p - vec3(0.0, 0.309, 0.0), vec3(0.291, 0.309, 0.202), 0.01);
    vec3 q = abs(p - vec3(0.0, 0.309, 0.0));
    d = carve(d, box(q - vec3(0.291, 0.189, 0.0), vec3(0.02, 0.02, 1.0)), 0.01);
    return min(d, prism((p - vec3(0.0, 0.698, 0.0)).xyz, vec2(0.111, 0.1)));
}

float post(vec3 p) {
    p -= vec3(-1.644, 0.0, -1.129);
    p.xz = turned(3.491) * p.xz;
    float d = cylinder(p - vec3(0.0, 0.370, 0.0), 0.279, 0.370);
    d += 0.01 * sin(30.0 * p.y) * cos(8.0 * atan(p.z, p.x));
    d = carve(d, cylinder(p - vec3(0.0, 0.790, 0.0), 0.249, 0.1), 0.02);
    return min(d, torus(p - vec3(0.0, 0.740, 0.0), vec2(0.279, 0.015)));
}

float plinth(vec3 p) {
    p -= vec3(-1.341, 0.0, -2.121);
    p.xz = turned(3.84) * p.xz;
    float d = round_box(p - vec3(0.0, 0.15, 0.0), vec3(0.15, 0.15, 0.15), 0.02);
    d = join(d, capsule(p, vec3(0.0, 0.4, 0.0), vec3(0.001, 0.889, 0.0), 0.116), 0.08);
    d = join(d, sphere(p - vec3(0.001, 1.039, 0.0), 0.08), 0.04);
    return join(d, capsule(p, vec3(-0.16, 0.6, 0.05), vec3(0.16, 0.697, 0.05), 0.03), 0.05);
}

float sundial(vec3 p) {
    p -= vec3(-0.875, 0.0, -2.858);
    p.xz = turned(4.189) * p.xz;
    float d = round_box(p - vec3(0.0, 0.3, 0.0), vec3(0.403, 0.04, 0.14), 0.02);
    vec3 q = vec3(abs(p.x) - 0.303, p.y - 0.14, abs(p.z) - 0.09);
    d = min(d, cylinder(q, 0.03, 0.14));
    return min(d, round_box(p - vec3(0.0, 0.5, 0.13), vec3(0.353, 0.1, 0.02), 0.01));
}

float jar(vec3 p) {
    p -= vec3(-0.304, 0.0, -3.25);
    p.xz = turned(4.538) * p.xz;
    float d = sphere(p - vec3(0.0, 0.339, 0.0), 0.294);
    d = join(d, cone(p - vec3(0.0, 0.539, 0.0), 0.1, 0.118, 0.113), 0.06);
    d = join(d, torus(p - vec3(0.0, 0.639, 0.0), vec2(0.113, 0.02)), 0.02);
    return min(d, cylinder(p - vec3(0.0, 0.02, 0.0), 0.274, 0.02));
}

float kerb(vec3 p) {
    p -= vec3(0.304, 0.0, -3.25);
    p.xz = turned(4.887) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 1.276, 0.0), 0.025);
    d = join(d, capsule(p, vec3(0.0, 1.276, 0.0), vec3(0.2, 1.376, 0.0), 0.02), 0.03);
    d = min(d, sphere(p - vec3(0.22, 1.296, 0.0), 0.068));
    return join(d, cone(p - vec3(0.0, 0.05, 0.0), 0.05, 0.180, 0.03), 0.03);
}

float well(vec3 p) {
    p -= vec3(0.875, 0.0, -2.858);
    p.xz = turned(5.236) * p.xz;
    float d = round_box(p - vec3(0.0, 0.192, 0.0), vec3(0.277, 0.192, 0.194), 0.01);
    vec3 q = abs(p - vec3(0.0, 0.192, 0.0));
    d = carve(d, box(q - vec3(0.277, 0.072, 0.0), vec3(0.02, 0.02, 1.0)), 0.01);
    return min(d, prism((p - vec3(0.0, 0.464, 0.0)).xyz, vec2(0.119, 0.1)));
}

float easel(vec3 p) {
    p -= vec3(1.341, 0.0, -2.121);
    p.xz = turned(5.585) * p.xz;
    float d = cylinder(p - vec3(0.0, 0.323, 0.0), 0.259, 0.323);
    d += 0.01 * sin(30.0 * p.y) * cos(8.0 * atan(p.z, p.x));
    d = carve(d, cylinder(p - vec3(0.0, 0.696, 0.0), 0.229, 0.1), 0.02);
    return min(d, torus(p - vec3(0.0, 0.646, 0.0), vec2(0.259, 0.015)));
}

float gong(vec3 p) {
    p -= vec3(1.644, 0.0, -1.129);
    p.xz = turned(5.934) * p.xz;
    float d = round_box(p - vec3(0.0, 0.15, 0.0), vec3(0.15, 0.15, 0.15), 0.02);
    d = join(d, capsule(p, vec3(0.0, 0.4, 0.0), vec3(0.094, 0.844, 0.0), 0.113), 0.08);
    d = join(d, sphere(p - vec3(0.094, 0.994, 0.0), 0.08), 0.04);
    return join(d, capsule(p, vec3(-0.16, 0.6, 0.05), vec3(0.16, 0.701, 0.05), 0.03), 0.05);
}

float pew(vec3 p) {
    p -= vec3(1.222, 0.0, 0.718);
    p.xz = turned(0.349) * p.xz;
    float d = round_box(p - vec3(0.0, 0.227, 0.0), vec3(0.190, 0.03, 0.1), 0.01);
    vec3 q = vec3(abs(p.x) - 0.150, p.y - 0.08, p.z);
    return min(d, round_box(q, vec3(0.02, 0.119, 0.08), 0.005));
}

float vase(vec3 p) {
    p -= vec3(0.65, 0.0, 1.819);
    p.xz = turned(1.047) * p.xz;
    float d = sphere(p - vec3(0.0, 0.212, 0.0), 0.106);
    d = join(d, cone(p - vec3(0.0, 0.312, 0.0), 0.06, 0.084, 0.089), 0.04);
    return carve(d, sphere(p - vec3(0.0, 0.382, 0.0), 0.063), 0.01);
}

float lantern(vec3 p) {
    p -= vec3(-0.226, 0.0, 2.068);
    p.xz = turned(1.745) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 0.596, 0.0), 0.02);
    d = min(d, torus(p - vec3(0.0, 0.426, 0.0), vec2(0.098, 0.012)));
    return min(d, round_box(p - vec3(0.0, 0.616, 0.0), vec3(0.053, 0.05, 0.05), 0.01));
}

float chest(vec3 p) {
    p -= vec3(-0.996, 0.0, 1.35);
    p.xz = turned(2.443) * p.xz;
    float d = round_box(p - vec3(0.0, 0.231, 0.0), vec3(0.234, 0.03, 0.1), 0.01);
    vec3 q = vec3(abs(p.x) - 0.194, p.y - 0.08, p.z);
    return min(d, round_box(q, vec3(0.02, 0.120, 0.08), 0.005));
}

float drum(vec3 p) {
    p -= vec3(-1.3, 0.0, 0.0);
    p.xz = turned(3.142) * p.xz;
    float d = sphere(p - vec3(0.0, 0.148, 0.0), 0.123);
    d = join(d, cone(p - vec3(0.0, 0.248, 0.0), 0.06, 0.094, 0.098), 0.04);
    return carve(d, sphere(p - vec3(0.0, 0.318, 0.0), 0.069), 0.01);
}

float idol(vec3 p) {
    p -= vec3(-0.996, 0.0, -1.35);
    p.xz = turned(3.840) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 0.561, 0.0), 0.02);
    d = min(d, torus(p - vec3(0.0, 0.407, 0.0), vec2(0.062, 0.012)));
    return min(d, round_box(p - vec3(0.0, 0.581, 0.0), vec3(0.105, 0.05, 0.05), 0.01));
}

float settle(vec3 p) {
    p -= vec3(-0.226, 0.0, -2.068);
    p.xz = turned(4.538) * p.xz;
    float d = round_box(p - vec3(0.0, 0.260, 0.0), vec3(0.164, 0.03, 0.1), 0.01);
    vec3 q = vec3(abs(p.x) - 0.124, p.y - 0.08, p.z);
    return min(d, round_box(q, vec3(0.02, 0.135, 0.08), 0.005));
}

float crock(vec3 p) {
    p -= vec3(0.65, 0.0, -1.819);
    p.xz = turned(5.236) * p.xz;
    float d = sphere(p - vec3(0.0, 0.213, 0.0), 0.109);
    d = join(d, cone(p - vec3(0.0, 0.313, 0.0), 0.06, 0.088, 0.050), 0.04);
    return carve(d, sphere(p - vec3(0.0, 0.383, 0.0), 0.035), 0.01);
}

float mast(vec3 p) {
    p -= vec3(1.222, 0.0, -0.718);
    p.xz = turned(5.934) * p.xz;
    float d = capsule(p, vec3(0.0), vec3(0.0, 0.556, 0.0), 0.02);
    d = min(d, torus(p - vec3(0.0, 0.391, 0.0), vec2(0.047, 0.012)));
    return min(d, round_box(p - vec3(0.0, 0.576, 0.0), vec3(0.083, 0.05, 0.05), 0.01));
}

// The distance of the nearest surface, and its material.
vec2 map(vec3 p) {
    vec2 hit = vec2(ground(p), 0.0);
    hit = nearer(hit, vec2(arcade(p), 1.0));
    hit = nearer(hit, vec2(fountain(p), 1.0));
    hit = nearer(hit, vec2(water(p), 2.0));
    hit = nearer(hit, vec2(bench(p), 3.0));
    hit = nearer(hit, vec2(urn(p), 4.0));
    hit = nearer(hit, vec2(lamp(p), 5.0));
    hit = nearer(hit, vec2(crate(p), 3.0));
    hit = nearer(hit, vec2(stool(p), 4.0));
    hit = nearer(hit, vec2(bollard(p), 5.0));
    hit = nearer(hit, vec2(planter(p), 3.0));
    hit = nearer(hit, vec2(statue(p), 4.0));
    hit = nearer(hit, vec2(barrel(p), 5.0));
    hit = nearer(hit, vec2(trough(p), 3.0));
    hit = nearer(hit, vec2(post(p), 4.0));
    hit = nearer(hit, vec2(plinth(p), 5.0));
    hit = nearer(hit, vec2(sundial(p), 3.0));
    hit = nearer(hit, vec2(jar(p), 4.0));
    hit = nearer(hit, vec2(kerb(p), 5.0));
    hit = nearer(hit, vec2(well(p), 3.0));
    hit = nearer(hit, vec2(easel(p), 4.0));
    hit = nearer(hit, vec2(gong(p), 5.0));
    hit = nearer(hit, vec2(pew(p), 3.0));
    hit = nearer(hit, vec2(vase(p), 4.0));
    hit = nearer(hit, vec2(lantern(p), 5.0));
    hit = nearer(hit, vec2(chest(p), 3.0));
    hit = nearer(hit, vec2(drum(p), 4.0));
    hit = nearer(hit, vec2(idol(p), 5.0));
    hit = nearer(hit, vec2(settle(p), 3.0));
    hit = nearer(hit, vec2(crock(p), 4.0));
    hit = nearer(hit, vec2(mast(p), 5.0));
    return hit;
}

vec3 normal_at(vec3 p) {
    vec2 e = vec2(0.0015, -0.0015);
    return normalize(
        e.xyy * map(p + e.xyy).x +
        e.yyx * map(p + e.yyx).x +
        e.yxy * map(p + e.yxy).x +
        e.xxx * map(p + e.xxx).x);
}

// The way to a surface, and its material; below zero for none.
vec2 march(vec3 from, vec3 along) {
    float t = 0.02;
    for (int i = 0; i < 128; i++) {
        vec2 hit = map(from + t * along);
        if (hit.x < NEAR_ENOUGH * t) {
            return vec2(t, hit.y);
        }
        t += 0.9 * hit.x;
        if (t > FAR) {
            break;
        }
    }
    return vec2(-1.0);
}

float shadow(vec3 from, vec3 along) {
    float light = 1.0;
    float t = 0.03;
    for (int i = 0; i < 32; i++) {
        float d = map(from + t * along).x;
        light = min(light, 10.0 * d / t);
        t += clamp(d, 0.03, 0.4);
        if (light < 0.01 || t > 8.0) {
            break;
        }
    }
    return clamp(light, 0.0, 1.0);
}

float occlusion(vec3 p, vec3 n) {
    float sum = 0.0;
    float weight = 1.0;
    for (int i = 1; i <= 5; i++) {
        float away = 0.06 * float(i);
        sum += weight * (away - map(p + away * n).x);
        weight *= 0.7;
    }
    return clamp(1.0 - 2.0 * sum, 0.0, 1.0);
}

vec3 sky(vec3 along) {
    float height = max(along.y, 0.0);
    vec3 blue = mix(vec3(0.75, 0.82, 0.9), vec3(0.2, 0.4, 0.75), sqrt(height));
    float sun = max(dot(along, normalize(SUN)), 0.0);
    blue += vec3(1.0, 0.7, 0.4) * (0.3 * pow(sun, 16.0) + pow(sun, 400.0));
    if (along.y > 0.02) {
        float cover = clouds(3.0 * along.xz / along.y + 0.05 * iTime);
        blue = mix(blue, vec3(1.0), smoothstep(0.45, 0.75, cover) * smoothstep(0.02, 0.25, along.y));
    }
    return blue;
}

vec3 albedo(vec3 p, float material) {
    if (material < 0.5) {
        float slab = random_of(floor(p.xz));
        return mix(vec3(0.36, 0.33, 0.3), vec3(0.5, 0.46, 0.4), slab) * (0.8 + 0.4 * noise(8.0 * p.xz));
    }
    if (material < 1.5) {
        return vec3(0.75, 0.7, 0.62) * (0.85 + 0.3 * noise(5.0 * p.xy + 3.0 * p.zz));
    }
    if (material < 2.5) {
        return vec3(0.05, 0.2, 0.25);
    }
    if (material < 3.5) {
        return mix(vec3(0.35, 0.2, 0.1), vec3(0.5, 0.3, 0.15), 0.5 + 0.5 * sin(40.0 * p.y + 6.0 * noise(9.0 * p.xz)));
    }
    if (material < 4.5) {
        return vec3(0.6, 0.3, 0.2);
    }
    return vec3(0.25, 0.3, 0.28);
}

vec3 lit(vec3 p, vec3 n, vec3 along, float material) {
    vec3 sun = normalize(SUN);
    float direct = max(dot(n, sun), 0.0);
    if (direct > 0.0) {
        direct *= shadow(p + 0.004 * n, sun);
    }
    float open = occlusion(p, n);
    float above = 0.5 + 0.5 * n.y;
    vec3 light = 1.6 * direct * vec3(1.0, 0.9, 0.75) + 0.6 * above * open * vec3(0.4, 0.55, 0.8);
    light += 0.15 * (1.0 - above) * open * vec3(0.5, 0.4, 0.3);
    vec3 colour = albedo(p, material) * light;
    vec3 halfway = normalize(sun - along);
    float shine = material > 1.5 && material < 2.5 ? 120.0 : 24.0;
    colour += direct * pow(max(dot(n, halfway), 0.0), shine) * 0.4;
    float rim = pow(1.0 - max(dot(n, -along), 0.0), 5.0);
    return mix(colour, sky(reflect(along, n)), rim * (material > 1.5 && material < 2.5 ? 0.8 : 0.15));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float angle = 0.15 * iTime + 0.6;
    vec3 from = vec3(4.6 * sin(angle), 1.7 + 0.2 * sin(0.3 * iTime), 5.5 * cos(angle));
    vec3 forward = normalize(vec3(0.0, 0.8, 0.0) - from);
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, forward);
    vec3 along = normalize(uv.x * right + uv.y * up + 1.7 * forward);
    vec3 colour = sky(along);
    vec2 hit = march(from, along);
    if (hit.x > 0.0) {
        vec3 p = from + hit.x * along;
        vec3 n = normal_at(p);
        vec3 surface = lit(p, n, along, hit.y);
        colour = mix(surface, colour, 1.0 - exp(-0.0008 * hit.x * hit.x * hit.x));
    }
    colour = colour / (1.0 + 0.4 * colour);
    fragColor = vec4(pow(colour, vec3(1.0 / 2.2)), 1.0);
}
