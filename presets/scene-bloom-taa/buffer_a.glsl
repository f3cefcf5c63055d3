// The scene: spheres on a polished floor, some of them lamps. Every ray meets them in closed form. Alpha is how far
// along its ray (as rayThrough gives it) the first hit is.

const int SPHERES = 8;
const vec4 SPHERE[SPHERES] = vec4[SPHERES]( // centre, radius
    vec4(0.00, 0.80, 0.00, 0.80), vec4(1.45, 0.40, 0.55, 0.40), vec4(-1.25, 0.55, 0.85, 0.55),
        vec4(-0.75, 0.30, -1.30, 0.30),
    vec4(0.75, 0.16, 1.35, 0.16), vec4(1.30, 0.20, -0.95, 0.20), vec4(-2.10, 0.13, -0.30, 0.13),
        vec4(0.05, 0.11, 1.75, 0.11));
const int FIRST_LAMP = 4; // from here on
const vec3 COLOUR[SPHERES] = vec3[SPHERES](
    vec3(0.90, 0.90, 0.92), vec3(0.85, 0.22, 0.12), vec3(0.10, 0.30, 0.55), vec3(0.85, 0.68, 0.20),
    vec3(1.00, 0.42, 0.12), vec3(0.15, 0.55, 1.00), vec3(0.95, 0.12, 0.50), vec3(0.60, 1.00, 0.45));

const float FAR = 60.0;
const int FLOOR = SPHERES, SKY = SPHERES + 1;

vec3 lampLight(int i) {
    return COLOUR[i] * lamps * (0.85 + 0.15 * sin(2.0 * iTime + 2.4 * float(i)));
}

// Distance along `towards` (of any length), and what is there.
float trace(vec3 from, vec3 towards, out int what) {
    float nearest = FAR, a = dot(towards, towards);
    what = SKY;
    float floor_ = -from.y / towards.y;
    if (towards.y < 0.0 && floor_ < nearest) {
        nearest = floor_;
        what = FLOOR;
    }
    for (int i = 0; i < SPHERES; i++) {
        vec3 q = from - SPHERE[i].xyz;
        float b = dot(q, towards), c = dot(q, q) - SPHERE[i].w * SPHERE[i].w, h = b * b - a * c;
        float t = h > 0.0 ? (-b - sqrt(h)) / a : -1.0;
        if (t > 1e-3 && t < nearest) {
            nearest = t;
            what = i;
        }
    }
    return nearest;
}

vec3 sky(vec3 d) {
    return mix(vec3(0.030, 0.022, 0.040), vec3(0.003, 0.005, 0.014), smoothstep(-0.02, 0.35, d.y));
}

// Light that the lamps send to a point, as from balls without shadows, and how much of the sky the spheres leave it.
vec3 received(vec3 p, vec3 n, int self) {
    vec3 sum = vec3(0.0);
    float open = 0.5 + 0.5 * n.y;
    for (int i = 0; i < SPHERES; i++) {
        vec3 q = SPHERE[i].xyz - p;
        float d2 = dot(q, q), r2 = SPHERE[i].w * SPHERE[i].w;
        if (i == self) continue;
        float facing = max(dot(n, q) * inversesqrt(d2), 0.0), solid = r2 / max(d2, r2); // of a ball seen from p
        if (i >= FIRST_LAMP) sum += lampLight(i) * facing * solid;
        else open *= 1.0 - facing * solid;
    }
    return sum + open * vec3(0.05, 0.06, 0.09);
}

vec3 normalOf(vec3 p, int what) {
    return what == FLOOR ? vec3(0.0, 1.0, 0.0) : (p - SPHERE[what].xyz) / SPHERE[what].w;
}

vec3 paint(vec3 p, int what) {
    if (what != FLOOR) return COLOUR[what];
    vec2 tile = floor(p.xz * 1.5);
    return vec3(mod(tile.x + tile.y, 2.0) < 1.0 ? 0.035 : 0.14);
}

// Light that comes back from a hit, without its reflection.
vec3 shade(vec3 p, vec3 n, vec3 d, int what) {
    if (what == SKY) return sky(d);
    if (what >= FIRST_LAMP && what < SPHERES) return lampLight(what) * (0.55 + 0.45 * max(-dot(n, d), 0.0));
    vec3 light = paint(p, what) * received(p, n, what);
    float fog = exp(-0.0045 * dot(p, p));
    return mix(sky(d), light, fog);
}

void mainImage(out vec4 light, in vec2 fragCoord) {
    Camera c = camera(iTime, iMouse, iResolution.xy);
    vec3 ray = rayThrough(c, fragCoord + jitter(iFrame), iResolution.xy), d = normalize(ray);
    int what;
    float t = trace(c.from, ray, what);
    vec3 p = c.from + t * ray, n = what == SKY ? -d : normalOf(p, what);
    light = vec4(shade(p, n, d, what), t);
    if (what == FLOOR || what < FIRST_LAMP) { // one reflection; C. Schlick's Fresnel term, Eurographics 1994
        vec3 mirrored = reflect(d, n);
        int seen;
        float far = trace(p + 1e-3 * n, mirrored, seen);
        vec3 q = p + far * mirrored, m = seen == SKY ? -mirrored : normalOf(q, seen);
        float plain = what == FLOOR ? 0.10 : what == 0 ? 0.70 : 0.05;
        float fresnel = plain + (1.0 - plain) * pow(1.0 - clamp(-dot(n, d), 0.0, 1.0), 5.0);
        fresnel *= exp(-0.0045 * dot(p, p));
        light.rgb = mix(light.rgb, shade(q, m, mirrored, seen), fresnel);
    }
}
