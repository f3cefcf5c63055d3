// The sheet behind the scene: a sun, and dots that grow towards the edge. Channel 0 is the scene, twice as large as
// this; its colours are multiplied by what it covers.

#iUniform color3 paper = color3(0.33, 0.66, 0.72)
#iUniform color3 sun = color3(0.98, 0.80, 0.42)

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float unit = min(iResolution.y, iResolution.x / 1.5);
    vec2 p = (fragCoord - 0.5 * iResolution.xy) / unit;
    float pixel = 1.0 / unit, far = length(p - vec2(0.0, 0.08));
    vec3 colour = paper * (1.0 + 0.10 * p.y);
    vec2 q = mat2(0.7071, 0.7071, -0.7071, 0.7071) * p * 30.0;
    float dot_ = length(fract(q) - 0.5) - 0.62 * smoothstep(0.36, 1.15, far);
    colour = mix(colour, paper * vec3(0.62, 0.74, 0.86), smoothstep(30.0 * pixel, -30.0 * pixel, dot_));
    colour = mix(colour, vec3(0.99, 0.95, 0.84), smoothstep(pixel, -pixel, far - 0.40));
    colour = mix(colour, sun, smoothstep(pixel, -pixel, far - 0.375));
    vec4 scene = textureLod(iChannel0, fragCoord / iResolution.xy, 0.0);
    fragColor = vec4(colour * (1.0 - scene.a) + scene.rgb, 1.0);
}
