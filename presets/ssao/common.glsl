// Screen-space ambient occlusion over a deferred pipeline of four passes:
//
//   1  geometry    meshes into four targets: albedo (w: specular), world position (w: 1), world normal, view position (w: 1);
//                  where nothing is, all are 0
//   2  occlusion   64 samples of the hemisphere over each texel's surface, against the view positions
//   3  blur        the mean over 4 x 4 texels, which is one of each turn of the samples
//   4  lighting    Phong's, with the light of the surroundings weighed by what is open
//
// Image puts together what pass 4 has made, by the mode that Space steps through, and smooths the edges. Only the lamp moves:
// passes 1 to 3 are drawn again when the camera turns, and rest otherwise.
//
// Method: M. Mittring, "Finding Next Gen: CryEngine 2", SIGGRAPH 2007 courses, section 8.5.4.3 (samples around a point held
// against the depth buffer, turned from texel to texel, then blurred); the hemisphere along the normal and the check of the
// range are D. Filion's and R. McNaughton's in "Effects & Techniques" (StarCraft II), SIGGRAPH 2008 courses. Directions are
// weighted by the cosine, so what is measured is the ambient term of a Lambertian surface: S. Zhukov, A. Iones,
// G. Kronin, "An Ambient Light Illumination Model", Rendering Techniques 1998.
//
// What it should be. Let a wall without ends, of height H, stand at distance d from a point of the floor. A sample at distance
// s from the point, in the direction w, lies inside of it if s w.x > d and s w.y < H (x to the wall, y up). With w weighted by
// the cosine, (w.x, w.z) is uniform on the unit disc, and for H >= radius the part inside is that of a disc's segment:
//
//   f(c) = (acos c - c sqrt(1 - c c)) / pi,  c = d / s < 1, and 0 beyond;   occlusion(d) = mean of f over the kernel's lengths
//
// with lengths s = radius (0.1 + 0.9 u u), u uniform. Measured at radii 0.3, 0.6 and 1 beside a wall higher
// than that, from two texels away on (tests/preset_ssao.rs): within 0.025 of it, 0.02 too little to 0.02 too much; 0.015 of that
// are `bias` (the wall begins so much later), 0.005 the kernel's 64 points, and the rest texels. Beyond the radius: exactly
// none, as on an open plane. Beside a wall lower than the radius up to 0.04 too little: a camera that looks over the wall's
// edge sees samples behind it, and no depth buffer knows how thick a wall is.

// Scales a picture so that the scene fits into a canvas that is narrower than 3 : 2. Goes with iProjection, in x and y.
vec2 fit(vec2 resolution) {
    return vec2(min(1.0, resolution.x / (1.5 * resolution.y)));
}
