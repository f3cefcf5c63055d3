// The line.

#include "clip.glsl"
#include "light.glsl"

#iUniform color3 outlineColour = color3(0.10, 0.07, 0.16)
#iUniform float blendBase = 0.15 in { 0.0, 1.0 }      // the part that the base colour, squared, has in the line's
#iUniform bool lightColoured = false                  // the line takes on the light's colour
#iUniform float lineAmbient = 0.0 in { 0.0, 1.0 }     // and in no component takes on less than this
#iUniform float outlineTexture = 0.6 in { 0.0, 1.0 }  // how much of its texture counts
#iUniform bool textureReplaces = false                // instead of the blend, not on top of it
#iUniform bool zOnly = false                          // the hull hides what is behind it, and has no colour
#iUniform float outlineWidth

in vec3 vColor;
in vec2 vPlace;
out vec4 colour;

void main() {
    if (zOnly || outlineWidth <= 0.0 || isClipped(vPlace)) discard;
    vec3 base = textureLod(iChannel0, vPlace, 0.0).rgb * vColor;
    vec3 line = textureReplaces ? outlineColour : mix(outlineColour, base * base, blendBase);
    if (lightColoured) line *= max(lightColour, lineAmbient);
    line *= mix(vec3(1.0), textureLod(iChannel2, vPlace, 0.0).rgb, outlineTexture);
    colour = vec4(line, 1.0);
}
