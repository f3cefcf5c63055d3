// Texel (0, 0) is the ball, place and velocity, in units and units a step; texels (c, 1 + r) are 1 while brick c of row r stands.
const ivec2 BRICKS = ivec2(16, 6);
const vec2 LOW = vec2(2.4, 2.4), HIGH = vec2(317.6, 159.6); // where the ball's centre may be
const vec2 HALF = vec2(11.6, 6.1);                          // of a brick, as much larger as the ball is
#iUniform vec2 start = vec2(160.0, 17.0) in { 0.0, 320.0 }
#iUniform vec2 way = vec2(1.0, 2.0) in { -400.0, 400.0 }

vec2 centreOf(int column, int row) {
    return (vec2(column, row) + 0.5) * vec2(20.0, 9.0) + vec2(0.0, 92.0);
}
