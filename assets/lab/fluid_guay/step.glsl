void mainImage(out vec4 state, in vec2 fragCoord) {
    state = stepped(iChannel0, fragCoord);
}
