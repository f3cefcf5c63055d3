// A mesh's hull. PAGE says which page of the textures is its own.

#iUniform int outlineMode = 0 in { 0, 1 }         // 0 along the normals, 1 positions scaled away from the mesh's origin
#iUniform float outlineWidth = 0.045 in { 0.0, 0.3 } // in units of the scene
#iUniform float nearest = 6.0 in { 0.0, 50.0 }    // up to this distance lines are whole
#iUniform float farthest = 24.0 in { 0.0, 60.0 }  // and from this on they are gone
#iUniform float widthMask = 1.0 in { 0.0, 1.0 }   // how much of the mask counts
#iUniform float zOnlyWidth = 1.0 in { 0.0, 1.0 }  // of the width, where the hull is depth alone; 0: the mesh itself
#iUniform bool zOnly
#iUniform bool bakedNormals = true                // normals from the texture, instead of the mesh's own
#iUniform float depthOffset = 0.06 in { -1.0, 4.0 } // pushes the hull away from the camera without making it smaller
#iUniform float spin

in vec3 aPosition;
in vec3 aNormal;
in vec4 aTangent;
in vec2 aUv;
in vec4 aColor;
out vec3 vColor;
out vec2 vPlace;

// The part of the width that is left at a distance.
float faded(float far) {
    float t = clamp((far - nearest) / max(farthest - nearest, 1e-4), 0.0, 1.0);
    return 1.0 - t * t * (3.0 - 2.0 * t);
}

void main() {
    mat3 turn = turned(SPINS * spin * iTime);
    vColor = aColor.rgb;
    vPlace = inPage(aUv, PAGE);
    vec3 normal = aNormal;
    if (bakedNormals && dot(aTangent.xyz, aTangent.xyz) > 0.0) {
        vec3 baked = textureLod(iChannel3, vPlace, 0.0).xyz * 2.0 - 1.0;
        normal = mat3(aTangent.xyz, aTangent.w * cross(aNormal, aTangent.xyz), aNormal) * baked;
    }
    normal = normalize(iNormalMatrix * (turn * normal));
    vec3 away = mat3(iModel) * (turn * aPosition);
    vec3 direction = normal;
    if (outlineMode == 1 && dot(away, away) > 0.0) direction = normalize(away) * (dot(away, normal) < 0.0 ? -1.0 : 1.0);

    float mask = mix(1.0, textureLod(iChannel1, vPlace, 0.0).x, widthMask);
    float width = outlineWidth * faded(distance(iCameraPosition, iModel[3].xyz)) * mask * (zOnly ? zOnlyWidth : 1.0);
    vec4 view = iView * vec4(iModel[3].xyz + away + width * direction, 1.0);
    gl_Position = iProjection * view;
    // Only depth is the pushed point's. It stays before the camera and before the far plane.
    vec4 pushed = iProjection * vec4(view.xy, min(view.z - depthOffset, -0.51), 1.0);
    if (depthOffset != 0.0) gl_Position.z = min(pushed.z / pushed.w, 0.9999) * gl_Position.w;
    gl_Position.xy *= fit(iResolution.xy);
}
