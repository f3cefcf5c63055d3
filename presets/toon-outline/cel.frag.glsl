// Three tones and a highlight. Between the tones there are dots, as in print.

#include "clip.glsl"
#include "light.glsl"

#iUniform float shadeLevel = 0.56 in { 0.0, 1.0 }  // half-Lambert terms below it are in the shade
#iUniform float deepLevel = 0.27 in { 0.0, 1.0 }   // and below this in the deep shade
#iUniform float halftone = 0.16 in { 0.0, 0.5 }    // how wide the band of dots is
#iUniform float highlight = 0.5 in { 0.0, 1.0 }
#iUniform float rim = 0.5 in { 0.0, 1.0 }          // light along the edge that is turned away
#iUniform color3 shadeColour = color3(0.60, 0.56, 0.78)
#iUniform color3 deepColour = color3(0.36, 0.33, 0.58)

in vec3 vWorld;
in vec3 vNormal;
in vec3 vColor;
in vec2 vPlace;
out vec4 colour;

// 0 to 1 from the middle of a dot on: a threshold that makes a tone of so many dots. 60 rows on the picture's height.
float screen(vec2 p) {
    p = mat2(0.7071, 0.7071, -0.7071, 0.7071) * p * 84.0 / iResolution.y;
    vec2 q = cos(6.28318531 * p);
    return 0.5 - 0.25 * (q.x + q.y);
}

float tone(float light, float level) {
    float band = max(halftone, 1e-3), part = clamp((light - level) / band + 0.5, 0.0, 1.0);
    float edge = clamp(180.0 / iResolution.y, 0.02, 0.5); // soft by about a texel
    return smoothstep(-edge, edge, part * (1.0 + 2.0 * edge) - edge - screen(gl_FragCoord.xy));
}

void main() {
    if (isClipped(vPlace)) discard;
    vec3 normal = normalize(vNormal), view = normalize(iCameraPosition - vWorld), light = toLight();
    vec3 base = textureLod(iChannel0, vPlace, 0.0).rgb * vColor;
    float half_ = 0.5 + 0.5 * dot(normal, light);
    vec3 lit = mix(base * deepColour, mix(base * shadeColour, base * lightColour, tone(half_, shadeLevel)),
                   tone(half_, deepLevel));
    float shine = dot(normal, normalize(light + view));
    lit = mix(lit, vec3(1.0), highlight * smoothstep(0.978, 0.982, shine));
    float facing = dot(normal, view);
    lit += 0.35 * rim * base * smoothstep(0.30, 0.26, facing) * smoothstep(0.5, 0.4, half_);
    colour = vec4(lit, 1.0);
}
