// Smooth colours of the Mandelbrot set, which zooms slowly.
#define ITERATIONS 400
void mainImage(out vec4 color, in vec2 at) {
    vec2 uv = (2. * at - iResolution.xy) / iResolution.y, c = vec2(-.6, 0) + uv * (1.3 - .01 * mod(iTime, 20.)), z = vec2(0);
    float n = 0.;
    for (int i = 0; i < ITERATIONS; i++) {
        z = vec2(z.x * z.x - z.y * z.y, 2. * z.x * z.y) + c;
        if (dot(z, z) > 256.) break;
        n += 1.;
    }
    float smoothed = n - log2(.5 * log2(max(dot(z, z), 4.)));
    color = vec4(dot(z, z) > 256. ? .5 + .5 * cos(vec3(0, 1, 2) + .3 * smoothed) : vec3(0), 1);
}
