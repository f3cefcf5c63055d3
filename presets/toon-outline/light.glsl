#iUniform float lightAngle = 55.0 in { -180.0, 180.0 } // degrees about y, from +z towards +x
#iUniform float lightHeight = 40.0 in { -90.0, 90.0 }  // degrees above the horizon
#iUniform color3 lightColour = color3(1.0, 0.96, 0.88)

vec3 toLight() {
    vec2 a = radians(vec2(lightAngle, lightHeight));
    return vec3(sin(a.x) * cos(a.y), sin(a.y), cos(a.x) * cos(a.y));
}
