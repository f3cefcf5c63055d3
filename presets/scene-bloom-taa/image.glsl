// The lens and the film. Channel 0 is the history, channel 1 the bloom.

#iUniform float bloom = 0.22 in { 0.0, 1.0 }
#iUniform float aberration = 0.6 in { 0.0, 3.0 } // percent of the radius between red and blue
#iUniform float vignette = 0.8 in { 0.0, 1.5 }   // 1: the cos^4 law at this focal length
#iUniform float exposure = 0.8 in { -4.0, 4.0 }  // in stops
#iUniform float grain = 0.5 in { 0.0, 3.0 }      // in steps of an 8-bit screen

float hash(vec3 p) {
    p = fract(p * vec3(0.1031, 0.1030, 0.0973));
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}

vec3 at(vec2 uv) {
    vec2 inBloom = 0.5 * uv * iResolution.xy / iChannelResolution[1].xy; // its texels are two pixels wide at any size
    return mix(textureLod(iChannel0, uv, 0.0).rgb, textureLod(iChannel1, inBloom, 0.0).rgb, bloom);
}

// K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2015: a rational fit of the film curve.
vec3 film(vec3 x) {
    return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    vec2 uv = fragCoord / iResolution.xy, out_ = uv - 0.5;
    // A simple lens magnifies each colour a little differently: rims at the picture's edge go apart, its middle stays.
    float step_ = 0.005 * aberration;
    vec3 light = vec3(at(0.5 + out_ * (1.0 + step_)).r, at(uv).g, at(0.5 + out_ * (1.0 - step_)).b);
    vec2 q = out_ * iResolution.xy / unit(iResolution.xy) / FOCAL;
    light *= pow(1.0 + dot(q, q), -2.0 * vignette); // cos^4 of the angle, where the slider stands at 1
    vec3 shown = pow(film(light * exp2(exposure)), vec3(1.0 / 2.2));
    shown += grain / 255.0 * (hash(vec3(fragCoord, float(iFrame % 1024))) - 0.5) * 2.0;
    fragColor = vec4(clamp(shown, 0.0, 1.0), 1.0);
}
