// A drawing made from a G-buffer: lines where the geometry breaks, hatching where little light falls.
//
// Lines: Roberts' cross (L. Roberts, "Machine Perception of Three-Dimensional Solids", MIT 1963), the two diagonals of
// a square of texels, on depth and on normals, each with its own sensitivity. (T. Saito, T. Takahashi, "Comprehensible
// Rendering of 3-D Shapes", SIGGRAPH 1990, had the idea to take them from buffers of geometry.) A plain difference of
// depths finds lines all over a table seen at a low angle. So each end of a diagonal is held against the tangent plane
// of the other: on one plane both distances are zero at any angle.
//
// A line is `thickness` texels wide: as wide as the square.

#include "gbuffer.glsl"
