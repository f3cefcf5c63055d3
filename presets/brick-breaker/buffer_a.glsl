// The game. Channel 0 is this buffer in the last frame, channel 1 the keyboard.
//
// Every texel of the state plays the whole frame for itself from the last frame's state, comes to the same result as all
// the others, and keeps the one value it is the address of. That is wasteful by a factor of 112 and costs a GPU nothing.
//
// Collisions are swept: time of impact of the ball against every face (slabs: T. Kay, J. Kajiya, "Ray Tracing Complex
// Scenes", SIGGRAPH 1986, on boxes grown by the ball), then on from the earliest. Nothing is ever tested for overlap, so
// no speed tunnels. A reflection flips the sign of one velocity component: the speed stays the same to the last bit.
// The ball bounces as a square; it is drawn round.

const float SPEED = 180.0;          // units a second in level 1
const float SPEED_PER_LEVEL = 15.0;
const float KEY_SPEED = 260.0;      // of the paddle
const float MAX_STEP = 0.1;         // seconds; a longer hitch is slow motion, not a jump
const float LIVES = 3.0;
const float STEEPEST = 1.05;        // radians from the vertical, at the paddle's tips
const bool SOLID_FLOOR = false;     // true: practice, the ball cannot be lost

// Impacts a frame, far more than a game needs: at 10,000 units a frame the ball meets about 100 walls. Should they run
// out, the rest of the frame is dropped: the ball is late, never through.
const int MAX_IMPACTS = 512;
const uint TICKS = 0x40000000u; // in a frame

// A ball this close to a face and moving at it touches it. Without the tolerance a ball that meets two faces at once
// could be past the second by a rounding error when its turn comes, and never be stopped.
const float TOUCH = 1e-2;
const float NEVER = 1e9;

const int KEY_SPACE = 32, KEY_LEFT = 37, KEY_RIGHT = 39;

// ------------------------------------------------------------------------------------------- the state during a frame

vec2 ball, velocity;
float paddle, paddleBefore;
vec4 mouseSeen;
float score, lives, level, phase, phaseTime;
uint wall[ROWS];       // one bit a brick, bit 0 the leftmost
vec4 hits[BURSTS];     // of this frame, newest first
int hitCount;
bool fresh;            // the wall was built in this frame
int rows, impacts;     // ROWS and MAX_IMPACTS; 0 outside the state

vec4 load(ivec2 address) {
    return texelFetch(iChannel0, address, 0);
}

bool isFinite(vec4 q) {
    return all(lessThan(floatBitsToUint(q) & uvec4(0x7f800000u), uvec4(0x7f800000u)));
}

bool held(int key) { return texelFetch(iChannel1, ivec2(key, 0), 0).x > 0.5; }
bool pressed(int key) { return texelFetch(iChannel1, ivec2(key, 1), 0).x > 0.5; }

// ------------------------------------------------------------------------------------------------------------ the rules

bool brickInLevel(int column, int row, float number) {
    int kind = int(number) % 4;
    if (kind == 1) return true;
    if (kind == 2) return (column + row) % 2 == 0 || row == ROWS - 1;
    if (kind == 3) return abs(2 * column - COLUMNS + 1) <= 2 * row + 5;
    return column % 4 != 1 || row % 3 == 2;
}

void buildWall() {
    for (int r = 0; r < rows; r++) {
        wall[r] = 0u;
        for (int c = 0; c < COLUMNS; c++) {
            if (brickInLevel(c, r, level)) wall[r] |= 1u << uint(c);
        }
    }
    fresh = true;
}

void enter(float next) {
    phase = next;
    phaseTime = 0.0;
}

void newGame(float next) {
    score = 0.0;
    lives = LIVES;
    level = 1.0;
    buildWall();
    enter(next);
}

float speed() {
    return SPEED + SPEED_PER_LEVEL * min(level - 1.0, 8.0);
}

// Up and off the paddle, the steeper the nearer to its tip (-1..1).
void launch(float tip) {
    float angle = STEEPEST * clamp(tip, -1.0, 1.0);
    velocity = speed() * vec2(sin(angle), cos(angle));
}

void remember(vec2 at, float colour) {
    for (int i = BURSTS - 1; i > 0; i--) hits[i] = hits[i - 1];
    hits[0] = vec4(at, 0.0, colour);
    hitCount = min(hitCount + 1, BURSTS);
}

bool wallIsDown() {
    uint left = 0u;
    for (int r = 0; r < rows; r++) left |= wall[r];
    return left == 0u;
}

// ---------------------------------------------------------------------------------------------------------- the sweep

// Seconds until the ball, moving along one axis, is at `face`; NEVER if it moves away or is past it.
float timeTo(float face, float at, float v) {
    float far = (face - at) * sign(v);
    return v == 0.0 || far < -TOUCH ? NEVER : max(far, 0.0) / abs(v);
}

// Seconds until the ball enters the box, and through which face: x (true) or y. A vertex hit dead on counts as both faces,
// one after the other: the second is touched when the first has been dealt with.
float timeToBox(vec2 centre, vec2 halfSize, out bool throughX) {
    vec2 near = vec2(-NEVER), far = vec2(NEVER);
    for (int k = 0; k < 2; k++) {
        float low = centre[k] - halfSize[k] - ball[k], high = centre[k] + halfSize[k] - ball[k];
        float v = velocity[k];
        if (v == 0.0) {
            if (low >= 0.0 || high <= 0.0) return NEVER;
        } else {
            near[k] = (v > 0.0 ? low : high) / v;
            far[k] = (v > 0.0 ? high : low) / v;
        }
    }
    throughX = near.x > near.y;
    float enters = max(near.x, near.y);
    float leaves = min(far.x, far.y);
    float touch = TOUCH / max(abs(velocity.x), abs(velocity.y));
    return enters < leaves && enters >= -touch ? max(enters, 0.0) : NEVER;
}

// Moves the ball for `seconds`; the paddle glides from where it was to where it is meanwhile.
void sweep(float seconds) {
    // Time passed is counted in whole TICKS of the frame. A sum of floats would round the same flight from wall to wall the
    // same way again and again: 4 units in 100,000 bounces at 10,000 units a frame, against 1 as it is, which is a float's
    // precision of the path. (Carrying along what a sum drops is no help: compilers may, and some do, find that it is zero.)
    uint passed = 0u;
    for (int n = 0; n < impacts; n++) {
        float rest = seconds * (float(TICKS - passed) / float(TICKS));
        if (rest <= 0.0) break;

        // The earliest face. Of equals the first asked is taken: edges, paddle, bricks from the bottom left.
        float first = rest;
        int what = 0; // 1 left or right edge, 2 ceiling, 3 floor, 4 paddle, 5 brick
        float edge = velocity.x > 0.0 ? FIELD.x - BALL_RADIUS : BALL_RADIUS;
        float t = timeTo(edge, ball.x, velocity.x);
        if (t < first) { first = t; what = 1; }

        if (velocity.y > 0.0) {
            t = timeTo(CEILING - BALL_RADIUS, ball.y, velocity.y);
            if (t < first) { first = t; what = 2; }
        } else {
            t = timeTo(SOLID_FLOOR ? BALL_RADIUS : -BALL_RADIUS, ball.y, velocity.y);
            if (t < first) { first = t; what = 3; }
            t = timeTo(PADDLE_Y + PADDLE_HALF.y + BALL_RADIUS, ball.y, velocity.y);
            float there = mix(paddleBefore, paddle, clamp(float(passed) / float(TICKS) + t / seconds, 0.0, 1.0));
            if (t < first && abs(ball.x + velocity.x * t - there) <= PADDLE_HALF.x + BALL_RADIUS) { first = t; what = 4; }
        }

        int column = 0, row = 0;
        bool throughX = false;
        for (int r = 0; r < rows; r++) {
            if (wall[r] == 0u) continue;
            for (int c = 0; c < COLUMNS; c++) {
                if ((wall[r] >> uint(c) & 1u) == 0u) continue;
                bool x;
                t = timeToBox(brickCentre(c, r), 0.5 * BRICK - GAP + BALL_RADIUS, x);
                if (t < first) { first = t; what = 5; column = c; row = r; throughX = x; }
            }
        }

        ball += velocity * first;
        if (what == 0) break;
        passed = min(passed + uint(first / seconds * float(TICKS) + 0.5), TICKS);
        float part = float(passed) / float(TICKS);
        if (what == 1) {
            ball.x = edge;
            velocity.x = -velocity.x;
            remember(ball + vec2(sign(-velocity.x) * BALL_RADIUS, 0.0), SPARK);
        } else if (what == 2) {
            ball.y = CEILING - BALL_RADIUS;
            velocity.y = -velocity.y;
            remember(ball + vec2(0.0, BALL_RADIUS), SPARK);
        } else if (what == 3) {
            if (!SOLID_FLOOR) {
                lives -= 1.0;
                enter(lives > 0.0 ? READY : OVER);
                break;
            }
            ball.y = BALL_RADIUS;
            velocity.y = -velocity.y;
        } else if (what == 4) {
            ball.y = PADDLE_Y + PADDLE_HALF.y + BALL_RADIUS;
            float there = mix(paddleBefore, paddle, part);
            launch((ball.x - there) / (PADDLE_HALF.x + BALL_RADIUS));
            remember(ball - vec2(0.0, BALL_RADIUS), SPARK);
        } else {
            if (throughX) velocity.x = -velocity.x;
            else velocity.y = -velocity.y;
            wall[row] &= ~(1u << uint(column));
            score += 10.0 * float(row + 1);
            remember(brickCentre(column, row), float(row));
            if (wallIsDown()) {
                level += 1.0;
                buildWall();
                enter(phase == DEMO ? DEMO : READY);
                break;
            }
        }
    }
}

// ------------------------------------------------------------------------------------------------------------ a frame

void loadGame() {
    vec4 b = load(BALL), pad = load(PADDLE), game = load(GAME), clock = load(CLOCK);
    ball = b.xy;
    velocity = b.zw;
    paddle = pad.x;
    mouseSeen = pad;
    score = game.x;
    lives = game.y;
    level = game.z;
    phase = game.w;
    phaseTime = clock.y;
    hitCount = 0;
    fresh = false;
    for (int r = 0; r < rows; r++) {
        wall[r] = 0u;
        for (int c = 0; c < COLUMNS; c++) {
            if (load(BRICKS + ivec2(c, r)).x > 0.5) wall[r] |= 1u << uint(c);
        }
    }
    bool broken = !isFinite(b) || !isFinite(pad) || !isFinite(game) || !isFinite(clock);
    if (iFrame == 0 || broken || clock.w != 1.0) {
        paddle = 0.5 * FIELD.x;
        mouseSeen = vec4(paddle, iMouse.xy, 0.0);
        newGame(DEMO);
        ball = vec2(paddle, PADDLE_Y + PADDLE_HALF.y + BALL_RADIUS);
        launch(0.42);
    }
}

void movePaddle(float seconds) {
    paddleBefore = paddle;
    if (phase == DEMO) {
        float aim = ball.x + 0.75 * PADDLE_HALF.x * sin(1.7 * iTime);
        paddle += clamp(aim - paddle, -2.0 * speed() * seconds, 2.0 * speed() * seconds);
    } else {
        paddle += ((held(KEY_RIGHT) ? 1.0 : 0.0) - (held(KEY_LEFT) ? 1.0 : 0.0)) * KEY_SPEED * seconds;
        // Any motion counts, not only iMouse.z > 0: a press in the canvas's first column has z = 0.
        if (iMouse.z > 0.0 || iMouse.xy != mouseSeen.yz) paddle = fieldFromPixels(iMouse.xy + 0.5, iResolution.xy).x;
    }
    paddle = clamp(paddle, PADDLE_HALF.x, FIELD.x - PADDLE_HALF.x);
}

void play() {
    loadGame();
    // Only when time has moved: while Eddy is paused, a frame drawn for a key or the mouse does not move the ball. The step
    // itself is iTimeDelta, as the difference of two large iTimes has few digits left.
    float seconds = iTime > load(CLOCK).x ? clamp(iTimeDelta, 0.0, MAX_STEP) : 0.0;
    phaseTime += seconds;

    bool clicked = iMouse.z > 0.0 && mouseSeen.w == 0.0;
    bool space = pressed(KEY_SPACE);
    bool moved = clicked || iMouse.xy != mouseSeen.yz;
    if (phase == DEMO && iFrame > 0 && (space || moved || held(KEY_LEFT) || held(KEY_RIGHT))) {
        newGame(READY);
        clicked = false; // this one woke the game up
    } else if (phase == OVER && (space || clicked) && phaseTime > 0.5) {
        newGame(READY);
        space = clicked = false;
    }

    movePaddle(seconds);
    if (phase == READY) {
        ball = vec2(paddle, PADDLE_Y + PADDLE_HALF.y + BALL_RADIUS);
        velocity = vec2(0.0);
        if (space || clicked) {
            launch(0.25 + 0.3 * sin(17.0 * iTime));
            enter(PLAY);
        }
    }
    if ((phase == DEMO || phase == PLAY) && seconds > 0.0) sweep(seconds);

    mouseSeen = vec4(paddle, iMouse.xy, iMouse.z > 0.0 ? 1.0 : 0.0);
    if (seconds == 0.0) hitCount = 0;
    phaseTime = min(phaseTime, 1e4);
}

void mainImage(out vec4 state, in vec2 fragCoord) {
    ivec2 p = ivec2(fragCoord);
    state = vec4(0.0);
    // The rest of the buffer keeps its zeros. On a GPU a discard or a return ends it there; a driver that draws on the
    // processor, or one that turns a discard into a demotion, runs the code all the same. So its loops get nothing to do.
    bool mine = p.x < STATE_SIZE.x && p.y < STATE_SIZE.y;
    rows = mine ? ROWS : 0;
    impacts = mine ? MAX_IMPACTS : 0;
    if (!mine) discard;
    play();

    bool stepped = iTime > load(CLOCK).x;
    float seconds = stepped ? clamp(iTimeDelta, 0.0, MAX_STEP) : 0.0;
    if (p == BALL) state = vec4(ball, velocity);
    else if (p == PADDLE) state = mouseSeen;
    else if (p == GAME) state = vec4(score, lives, level, phase);
    else if (p == CLOCK) state = vec4(iTime, phaseTime, 0.0, 1.0);
    else if (p.y == 0 && p.x < BURST.x + BURSTS) {
        int i = p.x - BURST.x;
        state = i < hitCount ? hits[i] : load(p - ivec2(hitCount, 0)) + vec4(0.0, 0.0, seconds, 0.0);
        if (iFrame == 0 || !isFinite(state)) state = vec4(0.0, 0.0, 1e3, SPARK);
    } else if (p.y == 0) {
        vec4 before = load(p == TRAIL ? BALL : p - ivec2(1, 0));
        state = stepped ? before : load(p);
        if (phase == READY || phase == OVER || !isFinite(state) || iFrame == 0) state = vec4(ball, 0.0, 0.0);
    } else {
        vec4 brick = load(p);
        bool whole = (wall[p.y - BRICKS.y] >> uint(p.x - BRICKS.x) & 1u) == 1u;
        bool breaks = brick.x > 0.5 && !whole;
        state = vec4(whole ? 1.0 : 0.0, fresh || breaks ? 0.0 : min(brick.y + seconds, 1e3), 0.0, 0.0);
        if (fresh && !whole) state.y = 1e3;
    }
}
