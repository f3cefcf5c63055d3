// How far from here that is which will be here after a step, in xy, and where that will be which is here now, in zw.
void mainImage(out vec4 paths, in vec2 fragCoord) {
    paths = vec4(departure(iChannel0, fragCoord, dt), departure(iChannel0, fragCoord, -dt)) - fragCoord.xyxy;
}
