// The game. Channel 0 is this buffer in the last frame, channel 1 the keyboard.
//
// Every texel of the state plays the whole frame for itself from the last frame's state, comes to the same result as
// all the others, and keeps the one value it is the address of. That is wasteful by a factor of 112 and costs a GPU
// nothing.
//
// Collisions are swept: time of impact of the ball against every face (slabs: T. Kay, J. Kajiya, "Ray Tracing Complex
// Scenes", SIGGRAPH 1986, on boxes grown by the ball), then on from the earliest. Nothing is ever tested for overlap,
// so no speed tunnels. A reflection flips the sign of one velocity component: the speed stays the same to the last bit.
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

// During a frame the ball is counted in whole ticks of a unit. A 32-bit float holds each of those up to 2^24, so from
// frame to frame nothing is lost, and a reflection is exact: what is left of the frame's way turns, and place plus rest
// is the mirrored end of the straight way, however an impact was rounded. After 100,000 bounces the ball is where the
// unfolded path has it, to the tick; with floats it was 1 unit off.
const float TICKS = 32768.0;
const float LONGEST = 2.0e9; // ticks a frame, 61,000 units

// A ball this many ticks past a face that it moves at touches it: impacts are rounded, by up to 3 ticks at 10,000 units
// a frame.
const int TOUCH = 8;
const float NEVER = 1e9;

const int KEY_SPACE = 32, KEY_LEFT = 37, KEY_RIGHT = 39;

// ------------------------------------------------------------------------------------- the state during a frame

vec2 ball, velocity;
float paddle, paddleBefore;
vec4 mouseSeen;
float score, lives, level, phase, phaseTime;
ivec2 at, rest;        // in ticks: the ball, and what is left of the frame's way
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

// ------------------------------------------------------------------------------------------------------ the rules

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

// ---------------------------------------------------------------------------------------------------- the sweep

int ticks(float units) {
    return int(clamp(roundEven(units * TICKS), -LONGEST, LONGEST));
}

ivec2 ticks(vec2 units) {
    return ivec2(ticks(units.x), ticks(units.y));
}

// What part of `rest` there is until the ball is at `face`, along one axis; NEVER if it moves away or is past it.
float partTo(int face, int from, int way) {
    int far = way > 0 ? face - from : from - face;
    return way == 0 || far < -TOUCH ? NEVER : float(max(far, 0)) / float(abs(way));
}

// What part of `rest` there is until the ball enters the box, and through which face: x (true) or y. At a vertex hit
// dead on it is y.
float partToBox(ivec2 centre, ivec2 halfSize, out bool throughX) {
    vec2 near = vec2(-NEVER), far = vec2(NEVER);
    for (int k = 0; k < 2; k++) {
        int low = centre[k] - halfSize[k] - at[k], high = centre[k] + halfSize[k] - at[k], way = rest[k];
        if (way == 0) {
            if (low >= 0 || high <= 0) return NEVER;
        } else {
            near[k] = float(way > 0 ? low : high) / float(way);
            far[k] = float(way > 0 ? high : low) / float(way);
        }
    }
    throughX = near.x > near.y;
    float enters = max(near.x, near.y);
    float leaves = min(far.x, far.y);
    float touch = float(TOUCH) / float(max(abs(rest.x), abs(rest.y)));
    return enters < leaves && enters >= -touch ? max(enters, 0.0) : NEVER;
}

// Moves the ball for `seconds`; the paddle glides from where it was to where it is meanwhile.
void sweep(float seconds) {
    at = ticks(ball);
    rest = ticks(velocity * seconds);
    ivec2 low = ivec2(ticks(BALL_RADIUS)), high = ticks(vec2(FIELD.x - BALL_RADIUS, CEILING - BALL_RADIUS));
    ivec2 brick = ticks(0.5 * BRICK - GAP + BALL_RADIUS);
    int above = ticks(PADDLE_Y + PADDLE_HALF.y + BALL_RADIUS);
    float whole = float(max(abs(rest.x), abs(rest.y))), gone = 0.0; // of the frame, up to the paddle's last hit
    for (int n = 0; n < impacts; n++) {
        if (rest == ivec2(0)) break;
        float left = float(max(abs(rest.x), abs(rest.y))) / whole;

        // The earliest face. Of equals the first asked is taken: edges, paddle, bricks from the bottom left.
        float first = 1.0;
        int what = 0; // 1 left or right edge, 2 ceiling, 3 floor, 4 paddle, 5 brick
        int edge = rest.x > 0 ? high.x : low.x, hitColumn = 0, hitRow = 0;
        float t = partTo(edge, at.x, rest.x);
        if (t < first) { first = t; what = 1; }

        int flat_ = rest.y > 0 ? high.y : SOLID_FLOOR ? low.y : -low.y;
        t = partTo(flat_, at.y, rest.y);
        if (t < first) { first = t; what = rest.y > 0 ? 2 : 3; }
        if (rest.y < 0) {
            t = partTo(above, at.y, rest.y);
            float there = mix(paddleBefore, paddle, clamp(gone + (1.0 - gone) * (1.0 - left * (1.0 - t)), 0.0, 1.0));
            if (t < first
                && abs((float(at.x) + float(rest.x) * t) / TICKS - there) <= PADDLE_HALF.x + BALL_RADIUS) {
                first = t;
                what = 4;
            }
        }

        bool throughX = false;
        for (int r = 0; r < rows; r++) {
            if (wall[r] == 0u) continue;
            for (int c = 0; c < COLUMNS; c++) {
                if ((wall[r] >> uint(c) & 1u) == 0u) continue;
                bool x;
                t = partToBox(ticks(brickCentre(c, r)), brick, x);
                if (t < first) { first = t; what = 5; hitColumn = c; hitRow = r; throughX = x; }
            }
        }

        // Along the axis of the hit the ball is at the face; along the other it is rounded, and the rest makes up for
        // it.
        ivec2 step_ = what == 0 ? rest : ivec2(roundEven(vec2(rest) * first));
        ivec2 centre = ticks(brickCentre(hitColumn, hitRow));
        bool isAcross = what == 1 || what == 5 && throughX;
        if (what == 1) step_.x = edge - at.x;
        else if (what == 2 || what == 3) step_.y = flat_ - at.y;
        else if (what == 4) step_.y = above - at.y;
        else if (what == 5 && throughX) step_.x = centre.x - (rest.x > 0 ? brick.x : -brick.x) - at.x;
        else if (what == 5) step_.y = centre.y - (rest.y > 0 ? brick.y : -brick.y) - at.y;
        at += step_;
        rest -= step_;
        ball = vec2(at) / TICKS;
        if (what == 0) break;
        if (what == 3 && !SOLID_FLOOR) {
            lives -= 1.0;
            enter(lives > 0.0 ? READY : OVER);
            break;
        }
        if (what == 4) {
            gone += (1.0 - gone) * (1.0 - float(max(abs(rest.x), abs(rest.y))) / whole);
            launch((ball.x - mix(paddleBefore, paddle, gone)) / (PADDLE_HALF.x + BALL_RADIUS));
            remember(ball - vec2(0.0, BALL_RADIUS), SPARK);
            rest = ticks(velocity * seconds * (1.0 - gone));
            whole = float(max(max(abs(rest.x), abs(rest.y)), 1));
            continue;
        }
        if (what == 1) remember(ball + vec2(sign(velocity.x) * BALL_RADIUS, 0.0), SPARK);
        if (what == 2) remember(ball + vec2(0.0, BALL_RADIUS), SPARK);
        if (isAcross) {
            velocity.x = -velocity.x;
            rest.x = -rest.x;
        } else {
            velocity.y = -velocity.y;
            rest.y = -rest.y;
        }
        if (what == 5) {
            wall[hitRow] &= ~(1u << uint(hitColumn));
            score += 10.0 * float(hitRow + 1);
            remember(brickCentre(hitColumn, hitRow), float(hitRow));
            if (wallIsDown()) {
                level += 1.0;
                buildWall();
                enter(phase == DEMO ? DEMO : READY);
                break;
            }
        }
    }
}

// ------------------------------------------------------------------------------------------------------ a frame

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
    // Only when time has moved: while Eddy is paused, a frame drawn for a key or the mouse does not move the ball. The
    // step itself is iTimeDelta, as the difference of two large iTimes has few digits left.
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
    // processor, or one that turns a discard into a demotion, runs the code all the same. So its loops get nothing to
    // do.
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
