struct Hit { float t; vec3 n; };
struct Ray { vec2 at; Hit near; Hit far; };
void mainImage(out vec4 c, in vec2 f) {
    vec2 at = f;
    Ray r;
    r.at = at;
    r.far = Hit(1.0, vec3(0.0, 1.0, 0.0));
    r.near.t = 2.0;
    r.near.n.xz = vec2(0.5);
    c = vec4(r.near.n.y, r.near.n.x, r.far.n.y, r.near.t);
}
