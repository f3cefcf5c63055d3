// GGX (B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007), alpha = roughness^2.
// A half vector about the z axis by two numbers in 0 to 1.
vec3 halfVector(vec2 u, float alpha) {
    float cosTheta = sqrt((1.0 - u.x) / (1.0 + (alpha * alpha - 1.0) * u.x));
    float sinTheta = sqrt(max(1.0 - cosTheta * cosTheta, 0.0));
    return vec3(sinTheta * cos(2.0 * PI * u.y), sinTheta * sin(2.0 * PI * u.y), cosTheta);
}

float ggx(float cosTheta, float alpha) {
    float a2 = alpha * alpha, d = cosTheta * cosTheta * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

// Points of Hammersley: as even as so few can be.
vec2 hammersley(int i, int n) {
    uint bits = uint(i);
    bits = (bits << 16u) | (bits >> 16u);
    bits = ((bits & 0x00ff00ffu) << 8u) | ((bits & 0xff00ff00u) >> 8u);
    bits = ((bits & 0x0f0f0f0fu) << 4u) | ((bits & 0xf0f0f0f0u) >> 4u);
    bits = ((bits & 0x33333333u) << 2u) | ((bits & 0xccccccccu) >> 2u);
    bits = ((bits & 0x55555555u) << 1u) | ((bits & 0xaaaaaaaau) >> 1u);
    return vec2((float(i) + 0.5) / float(n), float(bits >> 8u) / 16777216.0);
}
