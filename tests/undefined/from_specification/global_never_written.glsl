struct State { vec2 at; float speed; };
float scale = 2.0;
State state;
float zoom;
void start(vec2 f) { state.at = f * scale; zoom = 0.5; }
void mainImage(out vec4 c, in vec2 f) {
    start(f);
    c = vec4(state.at, state.speed, zoom);
}
