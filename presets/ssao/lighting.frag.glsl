// Phong's lighting: B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18, 1975. Channel 0 has albedo,
// channel 1 the world's positions, channel 2 its normals, channel 3 what is open. Target 0 gets the lamp's light,
// target 1 that of the surroundings, unoccluded; and what is open in the w of both.

#iUniform float lampHeight = 2.7 in { 0.5, 6.0 }
#iUniform float lampSpeed = 0.25 in { -2.0, 2.0 } // radians a second
#iUniform float lamp = 1.0 in { 0.0, 4.0 }
#iUniform float ambient = 1.0 in { 0.0, 4.0 }
#iUniform float shininess = 40.0 in { 1.0, 200.0 } // the exponent of the highlights
#iUniform bool blinn = false                       // J. Blinn's highlights, SIGGRAPH 1977: wider for the same exponent
#iUniform color3 lampColour = color3(1.0, 0.86, 0.68)
#iUniform color3 skyColour = color3(0.80, 0.90, 1.0)

layout(location = 0) out vec4 direct;
layout(location = 1) out vec4 surrounding;

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 albedo = texelFetch(iChannel0, p, 0), position = texelFetch(iChannel1, p, 0);
    vec3 normal = texelFetch(iChannel2, p, 0).xyz;
    direct = vec4(0.0, 0.0, 0.0, 1.0);
    surrounding = vec4(0.0, 0.0, 0.0, 1.0);
    if (position.w == 0.0) return;
    vec3 colour = albedo.rgb * albedo.rgb;
    float open = texelFetch(iChannel3, p, 0).x;

    float angle = 0.75 + 0.55 * sin(lampSpeed * iTime);
    vec3 to = vec3(1.9 * sin(angle), lampHeight, 1.9 * cos(angle)) - position.xyz;
    vec3 light = normalize(to), view = normalize(iCameraPosition - position.xyz);
    float fall = 9.0 / (1.5 + dot(to, to));
    float diffuse = max(dot(normal, light), 0.0);
    float shine = blinn ? dot(normal, normalize(light + view)) : dot(reflect(-light, normal), view);
    float specular = diffuse > 0.0 ? albedo.a * pow(max(shine, 0.0), shininess) : 0.0;
    direct = vec4(lamp * fall * lampColour * (0.72 * colour * diffuse + 0.35 * specular), open);
    // From above comes the sky's light, from below what the floor sends back.
    vec3 around = mix(vec3(0.62, 0.50, 0.42), skyColour, 0.5 + 0.5 * normal.y);
    surrounding = vec4(0.46 * ambient * around * colour, open);
}
