// Without a model the matrices are identities.
uniform mat4 u_modelViewProjectionMatrix, u_viewMatrix;
uniform mat3 u_normalMatrix;
uniform mat3 u_view2d;
uniform vec2 u_resolution;

void main() {
    vec2 at = gl_FragCoord.xy / u_resolution;
    vec3 moved = u_view2d * vec3(at, 1.0);
    vec4 seen = u_modelViewProjectionMatrix * vec4(at, 0.25, 1.0);
    vec3 normal = u_normalMatrix * vec3(0.3, at.x, 0.7);
    gl_FragColor = vec4(at.y < 0.33 ? moved.xyz * 0.8 : at.y < 0.66 ? seen.xyz : normal, seen.w * u_viewMatrix[3].w);
}
