// The rules of the house: sizes, where every piece of state lives, and the way from pixels to the field.
//
// Everything is measured in field units, never in pixels: the field is FIELD units large on every canvas, so a resize
// changes the drawing and not the game. State sits in the bottom-left 16 x 7 texels of Buffer A, the corner a resize
// keeps. Buffers are 32-bit floats: whole numbers are exact up to 2^24, and at 320 units a position is exact to 3e-5.

const vec2 FIELD = vec2(320.0, 180.0);
const float CEILING = 162.0; // above it the score

const int COLUMNS = 16;
const int ROWS = 6;
const vec2 BRICK = vec2(20.0, 9.0); // with half of the gap around it
const float GAP = 0.8;
const float WALL_BOTTOM = 92.0;

const float BALL_RADIUS = 2.4;
const vec2 PADDLE_HALF = vec2(22.0, 2.6);
const float PADDLE_Y = 12.0;

// Addresses in Buffer A.
const ivec2 BALL = ivec2(0, 0);    // position, velocity in units a second
const ivec2 PADDLE = ivec2(1, 0);  // x; the mouse as last seen: x, y in pixels, 1 while held
const ivec2 GAME = ivec2(2, 0);    // score, lives, level, phase
const ivec2 CLOCK = ivec2(3, 0);   // iTime of the last step, seconds in this phase, -, 1 once there is a game
// and five to the right, newest first: place of a hit, its age in seconds, its colour
const ivec2 BURST = ivec2(4, 0);
const int BURSTS = 6;
const ivec2 TRAIL = ivec2(10, 0);  // and five to the right, newest first: where the ball was
const int TRAILS = 6;
const ivec2 BRICKS = ivec2(0, 1);  // COLUMNS x ROWS: 1 while whole, seconds since it broke
const ivec2 STATE_SIZE = ivec2(16, 7);

// Phases.
const float DEMO = 0.0;  // nobody has touched anything: the game plays itself
const float READY = 1.0; // the ball sits on the paddle
const float PLAY = 2.0;
const float OVER = 3.0;

// Colours of bursts: a brick's row, or this for the paddle and the edges.
const float SPARK = -1.0;

// Canvas pixels to field units; the field is centred and as large as fits.
float pixelsPerUnit(vec2 resolution) {
    return min(resolution.x / FIELD.x, resolution.y / FIELD.y);
}

vec2 fieldFromPixels(vec2 pixels, vec2 resolution) {
    return (pixels - 0.5 * resolution) / pixelsPerUnit(resolution) + 0.5 * FIELD;
}

vec2 brickCentre(int column, int row) {
    return vec2(float(column) + 0.5, float(row) + 0.5) * BRICK + vec2(0.0, WALL_BOTTOM);
}
