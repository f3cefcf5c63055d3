// A mesh as it is. PAGE says which page of the textures is its own.

#iUniform float spin = 0.35 in { -3.0, 3.0 } // radians a second, of every mesh about its own y

in vec3 aPosition;
in vec3 aNormal;
in vec2 aUv;
in vec4 aColor;
out vec3 vWorld;
out vec3 vNormal;
out vec3 vColor;
out vec2 vPlace;

void main() {
    mat3 turn = turned(SPINS * spin * iTime);
    vec4 world = iModel * vec4(turn * aPosition, 1.0);
    vWorld = world.xyz;
    vNormal = iNormalMatrix * (turn * aNormal);
    vColor = aColor.rgb;
    vPlace = inPage(aUv, PAGE);
    gl_Position = iProjection * iView * world;
    gl_Position.xy *= fit(iResolution.xy);
}
