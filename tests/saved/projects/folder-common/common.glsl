const float k = 0.75;
vec3 tint(vec2 q) { return vec3(q, k); }
