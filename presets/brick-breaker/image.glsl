// Draws the game and decides nothing. Channel 0 is Buffer A.

const vec3 ROW_COLOUR[ROWS] = vec3[ROWS](vec3(0.04, 0.48, 0.55), vec3(0.16, 0.58, 0.24), vec3(0.92, 0.62, 0.08),
                                         vec3(0.92, 0.30, 0.06), vec3(0.82, 0.09, 0.17), vec3(0.38, 0.14, 0.72));
const vec3 LIGHT = vec3(0.86, 0.94, 1.00);

vec4 load(ivec2 address) {
    return texelFetch(iChannel0, address, 0);
}

// ------------------------------------------------------------------------------------------------------- shapes

// Signed distances, in field units.
float roundBox(vec2 p, vec2 halfSize, float radius) {
    vec2 q = abs(p) - halfSize + radius;
    return length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - radius;
}

float segment(vec2 p, vec2 a, vec2 b) {
    vec2 along = b - a;
    return length(p - a - along * clamp(dot(p - a, along) / max(dot(along, along), 1e-6), 0.0, 1.0));
}

float pixel; // the size of one, in field units

// How much of this pixel lies inside.
float inside(float d) {
    return clamp(0.5 - d / pixel, 0.0, 1.0);
}

// Four numbers in 0..1 for a point of the field and a number, of integers alone and so the same on every GPU: pcg4d
// (M. Jarzynski, M. Olano, "Hash Functions for GPU Rendering", JCGT 9(3), 2020).
vec4 hash(ivec2 at, int number) {
    uvec4 v = uvec4(ivec4(at, number, 0)) * 1664525u + 1013904223u;
    for (int i = 0; i < 2; i++) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        if (i == 0) v ^= v >> 16u;
    }
    return vec4(v >> 8u) / 16777216.0;
}

// ------------------------------------------------------------------------------------------------------- letters

// Dot-matrix glyphs, 3 x 5 bits, the top row first: the digits, then the letters that are needed.
const int GLYPHS = 21;
const int GLYPH[GLYPHS] = int[GLYPHS](31599, 11415, 29671, 29391, 23497, 31183, 31215, 29266, 31727, 31695,
                                      // A C E G L M O P R S V
                                      11245, 14627, 31143, 14699, 18727, 24557, 11114, 27556, 27565, 14478, 23402);
const int SPACE = -1;
const int LEVEL_GLYPH = 14;

// One glyph in a box 3 wide and 5 high with its bottom left at 0; every dot is a lamp.
float glyph(vec2 p, int which, float size) {
    vec2 q = p / size;
    if (which < 0 || q.x < 0.0 || q.y < 0.0 || q.x >= 3.0 || q.y >= 5.0) return 0.0;
    ivec2 dot_ = ivec2(q);
    int bit = dot_.y * 3 + 2 - dot_.x;
    if ((GLYPH[which] >> bit & 1) == 0) return 0.0;
    return inside(roundBox((fract(q) - 0.5) * size, vec2(0.49 * size), 0.12 * size));
}

// A number of `digits` digits, its bottom left at p = 0.
float number(vec2 p, float value, int digits, float size) {
    int place = int(floor(p.x / (4.0 * size)));
    if (place < 0 || place >= digits) return 0.0;
    float digit = mod(floor(value / pow(10.0, float(digits - 1 - place)) + 1e-3), 10.0);
    return glyph(p - vec2(float(place) * 4.0 * size, 0.0), int(digit), size);
}

const int LETTERS = 11;
const int PRESS_SPACE[LETTERS] = int[LETTERS](17, 18, 12, 19, 19, SPACE, 19, 17, 10, 11, 12);
const int GAME_OVER[LETTERS] = int[LETTERS](SPACE, 13, 10, 15, 12, SPACE, 16, 20, 12, 18, SPACE);

// A line of text, its middle at p = 0.
float line(vec2 p, int text[LETTERS], float size) {
    p += vec2(2.0 * float(LETTERS) - 0.5, 2.5) * size;
    int place = int(floor(p.x / (4.0 * size)));
    if (place < 0 || place >= LETTERS) return 0.0;
    return glyph(p - vec2(float(place) * 4.0 * size, 0.0), text[place], size);
}

// ------------------------------------------------------------------------------------------------------ the scene

vec3 backdrop(vec2 p) {
    float deep = length((p - vec2(0.5, 0.62) * FIELD) / FIELD);
    vec3 colour = mix(vec3(0.016, 0.021, 0.050), vec3(0.004, 0.005, 0.013), smoothstep(0.0, 0.8, deep));
    vec2 grid = abs(fract(p / 10.0 + 0.5) - 0.5) * 10.0;
    return colour + 0.006 * (1.0 - smoothstep(0.0, max(0.35, pixel), min(grid.x, grid.y)));
}

void bricks(inout vec3 colour, vec2 p) {
    vec2 cell = (p - vec2(0.0, WALL_BOTTOM)) / BRICK;
    ivec2 i = ivec2(floor(cell));
    if (i.x < 0 || i.y < 0 || i.x >= COLUMNS || i.y >= ROWS) return;
    vec4 brick = load(BRICKS + i);
    vec2 q = p - brickCentre(i.x, i.y);
    vec2 halfSize = 0.5 * BRICK - GAP;
    vec3 own = ROW_COLOUR[i.y];
    if (brick.x > 0.5) {
        float grown = smoothstep(0.0, 0.35, brick.y - 0.02 * float(i.x)); // a new wall rolls in from the left
        float d = roundBox(q, halfSize * grown, 1.6 * grown);
        float bevel = smoothstep(-1.6, -0.2, d);
        vec3 shade = own * (0.80 + 0.25 * q.y / halfSize.y);
        shade += bevel * (q.y + 0.3 * (-q.x / halfSize.x) > 0.0 ? 0.22 : -0.10) * (0.4 + own);
        colour = mix(colour, shade, inside(d) * step(0.01, grown));
    } else if (brick.y < 0.25) {
        float t = brick.y / 0.25;
        float d = roundBox(q, halfSize * (1.0 + 0.12 * t), 1.6);
        colour += (own + 0.5) * inside(d) * (1.0 - t) * (1.0 - t);
    }
}

// Shards of a brick fly in an arc; sparks of an edge are few and small.
vec3 bursts(vec2 p) {
    vec3 light = vec3(0.0);
    for (int i = 0; i < BURSTS; i++) {
        vec4 b = load(BURST + ivec2(i, 0));
        bool brick = b.w >= 0.0;
        float life = brick ? 0.8 : 0.3;
        if (b.z >= life || distance(p, b.xy) > (brick ? 60.0 : 24.0)) continue;
        float t = b.z / life;
        vec3 own = brick ? ROW_COLOUR[int(b.w) % ROWS] : LIGHT;
        light += own * 0.5 * (1.0 - t) * (1.0 - t) * exp(-dot(p - b.xy, p - b.xy) / (brick ? 160.0 : 40.0));
        int shards = brick ? 12 : 5;
        ivec2 place = ivec2(floor(b.xy + 0.25)); // the centre of a brick is a multiple of a half
        for (int k = 0; k < shards; k++) {
            vec4 random = hash(place, k);
            float angle = 6.2832 * random.x, fast = (brick ? 55.0 : 28.0) * (0.35 + 0.65 * random.y);
            vec2 at = b.xy + (brick ? vec2(8.0, 3.0) * (random.zw - 0.5) : vec2(0.0));
            at += vec2(cos(angle), sin(angle)) * fast * b.z + vec2(0.0, -60.0) * b.z * b.z * (brick ? 1.0 : 0.3);
            float size = (brick ? 1.3 : 0.7) * (1.0 - t);
            light += (own + 0.15) * inside(length(p - at) - size) * (1.0 - t);
        }
    }
    return light;
}

vec3 ballLight(vec2 p, vec2 at, bool moving) {
    vec3 light = vec3(0.0);
    if (moving) {
        vec2 newer = at;
        for (int i = 0; i < TRAILS; i++) {
            vec2 older = load(TRAIL + ivec2(i, 0)).xy;
            float k = float(i) / float(TRAILS);
            float d = segment(p, newer, older) - BALL_RADIUS * (0.85 - 0.75 * k);
            light = max(light, vec3(0.25, 0.55, 1.0) * inside(d) * 0.5 * (1.0 - k) * (1.0 - k));
            newer = older;
        }
    }
    float d = length(p - at) - BALL_RADIUS;
    light += vec3(0.35, 0.60, 1.0) * 0.30 * exp(-max(d, 0.0) / 3.0);
    return mix(light, vec3(1.0), inside(d));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    pixel = 1.0 / pixelsPerUnit(iResolution.xy);
    vec2 p = fieldFromPixels(fragCoord, iResolution.xy);
    vec4 ball = load(BALL), game = load(GAME), clock = load(CLOCK);
    float paddle = load(PADDLE).x;
    float phase = game.w, phaseTime = clock.y;

    // The state does not fit on a canvas this small: say so with a dull field instead of garbage.
    bool playable = all(greaterThanEqual(ivec2(iResolution.xy), STATE_SIZE));
    if (!playable || any(lessThan(p, vec2(0.0))) || any(greaterThan(p, FIELD))) {
        fragColor = vec4(0.02, 0.02, 0.03, 1.0);
        return;
    }

    vec3 colour = backdrop(p);
    // The frame: two edges and the ceiling, lit.
    float frame = min(min(p.x, FIELD.x - p.x), abs(p.y - CEILING));
    if (p.y > CEILING) frame = p.y - CEILING;
    colour += vec3(0.16, 0.30, 0.60) * (inside(frame - 0.5) + 0.25 * exp(-frame / 2.0));

    bricks(colour, p);

    vec2 toPaddle = p - vec2(paddle, PADDLE_Y);
    float d = roundBox(toPaddle, PADDLE_HALF, PADDLE_HALF.y);
    colour += vec3(0.10, 0.45, 0.55) * 0.35 * exp(-max(d, 0.0) / 4.0);
    vec3 metal = mix(vec3(0.16, 0.30, 0.42), vec3(0.80, 0.95, 1.00),
                     smoothstep(-PADDLE_HALF.y, PADDLE_HALF.y, toPaddle.y));
    metal = mix(metal, vec3(1.0, 0.55, 0.20), smoothstep(0.72, 0.76, abs(toPaddle.x) / PADDLE_HALF.x));
    colour = mix(colour, metal, inside(d));

    colour += bursts(p);
    if (phase != OVER) colour += ballLight(p, ball.xy, phase != READY);

    // Score, level, lives.
    vec2 bar = p - vec2(8.0, CEILING + 5.0);
    colour += vec3(1.0, 0.80, 0.35) * number(bar, game.x, 6, 1.7);
    colour += vec3(0.35, 0.50, 0.75) * (glyph(p - vec2(149.0, CEILING + 5.0), LEVEL_GLYPH, 1.7)
                                        + number(p - vec2(157.0, CEILING + 5.0), game.z, 2, 1.7));
    for (int i = 0; i < 3; i++) {
        float life = length(p - vec2(FIELD.x - 12.0 - 9.0 * float(i), CEILING + 9.2)) - BALL_RADIUS;
        colour += inside(life) * (float(i) < game.y ? vec3(0.85, 0.92, 1.0) : vec3(0.05, 0.07, 0.12));
    }

    vec2 middle = p - vec2(0.5 * FIELD.x, 58.0);
    float blink = 0.5 + 0.5 * cos(4.0 * phaseTime);
    if (phase == OVER) colour += vec3(1.0, 0.35, 0.30) * line(middle, GAME_OVER, 3.2);
    if (phase == READY || phase == DEMO || (phase == OVER && phaseTime > 1.0)) {
        colour += vec3(0.45, 0.65, 1.0) * (0.25 + 0.6 * blink)
            * line(middle + vec2(0.0, phase == OVER ? 22.0 : 0.0), PRESS_SPACE, 1.6);
    }
    fragColor = vec4(sqrt(max(colour, 0.0)), 1.0);
}
