// A hundred lines of the usual kind: two primitives and a floor are marched,
// with soft shadows, a little noise and a sky.

const float FAR = 40.0;
const int STEPS = 96;

float hash(vec2 p)
{
    return fract(sin(dot(p, vec2(127.1, 311.7))) * 43758.5453);
}

float noise(vec2 p)
{
    vec2 i = floor(p);
    vec2 f = fract(p);
    vec2 u = f * f * (3.0 - 2.0 * f);
    float a = mix(hash(i), hash(i + vec2(1.0, 0.0)), u.x);
    float b = mix(hash(i + vec2(0.0, 1.0)), hash(i + vec2(1.0, 1.0)), u.x);
    return mix(a, b, u.y);
}

float box(vec3 p, vec3 half_size)
{
    vec3 q = abs(p) - half_size;
    return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}

float scene(vec3 p)
{
    float ball = length(p - vec3(-0.9, 1.0, 0.0)) - 0.8;
    float block = box(p - vec3(1.1, 0.7, 0.2), vec3(0.6)) - 0.08;
    float ground = p.y - 0.1 * noise(p.xz * 2.0);
    return min(min(ball, block), ground);
}

vec3 normal_at(vec3 p)
{
    vec2 e = vec2(0.001, 0.0);
    float x = scene(p + e.xyy) - scene(p - e.xyy);
    float y = scene(p + e.yxy) - scene(p - e.yxy);
    float z = scene(p + e.yyx) - scene(p - e.yyx);
    return normalize(vec3(x, y, z));
}

float march(vec3 origin, vec3 direction)
{
    float t = 0.0;
    for (int i = 0; i < STEPS; i++)
    {
        float d = scene(origin + t * direction);
        if (d < 0.001 || t > FAR) break;
        t += 0.8 * d;
    }
    return t;
}

float shadow(vec3 origin, vec3 direction)
{
    float light = 1.0;
    float t = 0.02;
    for (int i = 0; i < 32; i++)
    {
        float d = scene(origin + t * direction);
        light = min(light, 12.0 * d / t);
        t += clamp(d, 0.02, 0.3);
    }
    return clamp(light, 0.0, 1.0);
}

vec3 sky(vec3 direction)
{
    return mix(vec3(0.9, 0.8, 0.7), vec3(0.3, 0.5, 0.8), max(direction.y, 0.0));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    vec2 uv = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
    float turn = 0.3 * iTime + 6.0 * iMouse.x / iResolution.x;
    vec3 eye = vec3(4.0 * cos(turn), 2.2, 4.0 * sin(turn));
    vec3 forward = normalize(vec3(0.0, 0.8, 0.0) - eye);
    vec3 right = normalize(cross(forward, vec3(0.0, 1.0, 0.0)));
    vec3 up = cross(right, forward);
    vec3 direction = normalize(uv.x * right + uv.y * up + 1.8 * forward);
    vec3 sun = normalize(vec3(0.6, 0.7, 0.4));

    vec3 color = sky(direction);
    float t = march(eye, direction);
    if (t < FAR)
    {
        vec3 p = eye + t * direction;
        vec3 n = normal_at(p);
        float diffuse = max(dot(n, sun), 0.0) * shadow(p, sun);
        vec3 albedo = 0.5 + 0.5 * cos(vec3(0.0, 0.6, 1.2) + 2.0 * p.y);
        color = albedo * (0.2 * sky(n) + diffuse);
        color = mix(color, sky(direction), 1.0 - exp(-0.002 * t * t));
    }
    float vignette = 1.0 - 0.15 * dot(uv, uv);
    color *= vignette;
    fragColor = vec4(sqrt(color), 1.0);
}
