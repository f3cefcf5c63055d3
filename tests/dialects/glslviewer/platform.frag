// The macro of a desktop platform is defined, and those of others are not.
uniform vec2 u_resolution;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
#if defined(PLATFORM_LINUX) || defined(PLATFORM_OSX) || defined(PLATFORM_WIN)
    gl_FragColor = vec4(at, 0.5, 1.0);
#endif
#if defined(PLATFORM_WEBGL) || defined(PLATFORM_RPI)
    gl_FragColor = vec4(1.0);
#endif
}
