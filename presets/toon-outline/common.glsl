// Cel shading with outlines by inverted hulls.
//
// Shading: a surface has few tones, and which one is a matter of thresholds on the angle to the light. A. Lake, C.
// Marshall, M. Harris, M. Blackstein, "Stylized Rendering Techniques for Scalable Real-Time 3D Animation", NPAR 2000.
//
// Lines: the mesh is drawn once more, larger, with its front faces culled. What is seen of the back faces is what
// stands out behind the mesh: a line around every silhouette, and where one part is before another. J. Rossignac, M.
// van Emmerik, "Hidden Contours on a Frame-Buffer", Eurographics Workshop on Graphics Hardware 1992; R. Raskar, M.
// Cohen, "Image Precision Silhouette Edges", I3D 1999. The properties of a line that are sliders here are those of the
// Unity-Chan Toon Shader 2.
//
// How wide a line is. A vertex moves by
//
//   w = outlineWidth * (1 - S((D - nearest) / (farthest - nearest))) * mask,   S(t) = t t (3 - 2 t) with t from 0 to 1,
//
// in units of the scene, D from the camera to the mesh's origin. A sphere of radius r in the middle of a picture H
// pixels high, seen with a field of view of `fov`, so has a line, along its normals, as many pixels wide as
//
//   H / (2 tan(fov / 2)) * ((r + w) / sqrt(D D - (r + w)^2) - r / sqrt(D D - r r))
//
// Along normals a mesh comes apart where its normals are split, as at a cube's edges. Two remedies: to scale positions
// away from the mesh's origin, which is right for what is star-shaped; or a texture with smooth normals, baked in the
// tangent frame.

// Texels of a page of a texture.
const vec2 PAGE_SIZE = vec2(256.0);
const float PAGES = 3.0;

// Where in a texture with pages the uv of a mesh is. The middles of the outer texels are at 0 and 1, so that no page
// runs into another and an edge is what was written there.
vec2 inPage(vec2 uv, float page) {
    vec2 at = (0.5 + clamp(uv, 0.0, 1.0) * (PAGE_SIZE - 1.0)) / PAGE_SIZE;
    return vec2((at.x + page) / PAGES, at.y);
}

// And the other way about: page and uv of a texel.
vec2 uvOfTexel(vec2 fragCoord, out int page) {
    page = int(fragCoord.x / PAGE_SIZE.x);
    return (fragCoord - vec2(float(page) * PAGE_SIZE.x, 0.0) - 0.5) / (PAGE_SIZE - 1.0);
}

// Scales a picture so that the scene fits into a canvas that is narrower than 3 : 2.
vec2 fit(vec2 resolution) {
    return vec2(min(1.0, resolution.x / (1.5 * resolution.y)));
}

// About y.
mat3 turned(float angle) {
    float c = cos(angle), s = sin(angle);
    return mat3(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
}
