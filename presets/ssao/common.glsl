// Screen-space ambient occlusion over a deferred pipeline of four passes:
//
//   1  geometry    meshes into three targets: albedo (w: specular), world position (w: the depth, along the axis of the
//                  camera), world normal; where nothing is, all are 0
//   2  occlusion   64 samples of the hemisphere over each texel's surface, against the positions and, from another
//                  geometry pass that draws nothing but backs, how far behind those the things end
//   3  blur        the mean over 4 x 4 texels, which is one of each turn of the samples
//   4  lighting    Phong's, with the light of the surroundings weighed by what is open
//
// Image puts together what pass 4 has made, by the mode that Space steps through, and smooths the edges. Only the lamp
// moves: passes 1 to 3 are drawn again when the camera turns, and rest otherwise.
//
// Method: M. Mittring, "Finding Next Gen: CryEngine 2", SIGGRAPH 2007 courses, section 8.5.4.3 (samples around a point
// held against the depth buffer, turned from texel to texel, then blurred); the hemisphere along the normal and the
// check of the range are D. Filion's and R. McNaughton's in "Effects & Techniques" (StarCraft II), SIGGRAPH 2008
// courses. Directions are weighted by the cosine, so what is measured is the ambient term of a Lambertian surface: S.
// Zhukov, A. Iones, G. Kronin, "An Ambient Light Illumination Model", Rendering Techniques 1998.
//
// What it should be (method 0). Let a wall without ends, of height H, stand at distance d from a point of the floor. A
// ray of the length s from the point, in the direction w, meets it if s w.x > d and d w.y / w.x < H (x to the wall, y
// up). With w weighted by the cosine, (w.x, w.z) is uniform on the unit disc, and for H >= radius the part that meets
// it is that of a disc's segment:
//
//   f(c) = (acos c - c sqrt(1 - c c)) / pi,  c = d / s < 1, and 0 beyond;   occlusion(d) = mean of f over the kernel's
//   lengths
//
// with lengths s = radius (0.1 + 0.9 u u), u uniform. Measured at radii 0.3, 0.6 and 1 beside a wall higher than that,
// from two texels away on (tests/it/preset_ssao.rs): within 0.016 of it. Beyond the radius: exactly none, as on an open
// plane. Beside a wall lower than the radius up to 0.03 too little: between two samples a ray goes over the edge
// unseen.
//
// Against 1,024 rays a point among the meshes, of the same falloff, power at 1 (tests/it/preset_occlusion.rs): 0.034
// off (root mean square, 320 x 180), nowhere 0.1 too much. The points of method 1 are 0.049 off; and before things
// ended at their backs it was 0.060, with a halo of 0.1 and more around them over 4 % of the picture.

// Scales a picture so that the scene fits into a canvas that is narrower than 3 : 2. Goes with iProjection, in x and y.
vec2 fit(vec2 resolution) {
    return vec2(min(1.0, resolution.x / (1.5 * resolution.y)));
}
