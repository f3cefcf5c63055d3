//! Functions that read textures or neighbouring pixels, sections 8.8 and 8.9, and Shadertoy's own.

use super::{
    constant::Constant::Each,
    overloads::{patterns::*, sig},
    row::{Form, Lod, Operation::*, ROW, Row},
};
use crate::ir::{Axis, Detail};

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    // 8.8 Textures; the sampler comes first.
    Row { name: "textureSize", params: "sampler, lod",
        overloads: &[
            sig(I2, &[S2, I1]), sig(I3, &[S3, I1]), sig(I2, &[SC, I1]), sig(I3, &[SA, I1]), sig(I2, &[D2, I1]),
            sig(I2, &[DC, I1]), sig(I3, &[DA, I1]), sig(I1, &[S1, I1]),
        ],
        operation: TextureSize, may_be_overloaded: true,
        text: "Width and height (and depth, or number of layers) in texels of level lod; 0 is full size. Undefined \
               for a level that does not exist.", ..ROW },
    Row { name: "texture", params: "sampler, P, bias",
        overloads: &[
            sig(G4, &[S2, F2]), sig(G4, &[S2, F2, F1]), sig(G4, &[S3, F3]), sig(G4, &[S3, F3, F1]), sig(G4, &[SC, F3]),
            sig(G4, &[SC, F3, F1]), sig(G4, &[SA, F3]), sig(G4, &[SA, F3, F1]), sig(F1, &[D2, F3]),
            sig(F1, &[D2, F3, F1]), sig(F1, &[DC, F4]), sig(F1, &[DC, F4, F1]), sig(F1, &[DA, F4]), sig(G4, &[S1, F1]),
            sig(G4, &[S1, F1, F1]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Implicit, offset: None }), may_be_overloaded: true,
        text: "Filtered read at P, 0 to 1 across the texture (a direction for a cube). The level follows from how \
               fast P changes between pixels, so it is undefined in branches that neighbours do not share; bias is \
               added to it.", ..ROW },
    Row { name: "textureProj", params: "sampler, P, bias",
        overloads: &[
            sig(G4, &[S2, F3]), sig(G4, &[S2, F3, F1]), sig(G4, &[S2, F4]), sig(G4, &[S2, F4, F1]), sig(G4, &[S3, F4]),
            sig(G4, &[S3, F4, F1]), sig(F1, &[D2, F4]), sig(F1, &[D2, F4, F1]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Implicit, offset: None }),
        text: "As `texture`, at P divided by its last component.", ..ROW },
    Row { name: "textureLod", params: "sampler, P, lod",
        overloads: &[
            sig(G4, &[S2, F2, F1]), sig(G4, &[S3, F3, F1]), sig(G4, &[SC, F3, F1]), sig(G4, &[SA, F3, F1]),
            sig(F1, &[D2, F3, F1]), sig(G4, &[S1, F1, F1]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Exact, offset: None }), may_be_overloaded: true,
        text: "Filtered read at P of the given level: 0 is full size, each level halves it. Works in any branch or \
               loop.", ..ROW },
    Row { name: "textureOffset", params: "sampler, P, offset, bias",
        overloads: &[
            sig(G4, &[S2, F2, I2]), sig(G4, &[S2, F2, I2, F1]), sig(G4, &[S3, F3, I3]), sig(G4, &[S3, F3, I3, F1]),
            sig(G4, &[SA, F3, I2]), sig(G4, &[SA, F3, I2, F1]), sig(F1, &[D2, F3, I2]), sig(F1, &[D2, F3, I2, F1]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Implicit, offset: Some(2) }),
        text: "As `texture`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "texelFetch", params: "sampler, P, lod",
        overloads: &[
            sig(G4, &[S2, I2, I1]), sig(G4, &[S3, I3, I1]), sig(G4, &[SA, I3, I1]), sig(G4, &[S1, I1, I1]),
        ],
        operation: Fetch { offset: None }, may_be_overloaded: true,
        text: "One texel, not filtered: P counts texels from (0, 0) at the bottom left. Outside the texture it gives \
               zeros, as WebGL does.", ..ROW },
    Row { name: "texelFetchOffset", params: "sampler, P, lod, offset",
        overloads: &[sig(G4, &[S2, I2, I1, I2]), sig(G4, &[S3, I3, I1, I3]), sig(G4, &[SA, I3, I1, I2])],
        operation: Fetch { offset: Some(3) },
        text: "As `texelFetch`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureProjOffset", params: "sampler, P, offset, bias",
        overloads: &[
            sig(G4, &[S2, F3, I2]), sig(G4, &[S2, F3, I2, F1]), sig(G4, &[S2, F4, I2]), sig(G4, &[S2, F4, I2, F1]),
            sig(G4, &[S3, F4, I3]), sig(G4, &[S3, F4, I3, F1]), sig(F1, &[D2, F4, I2]), sig(F1, &[D2, F4, I2, F1]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Implicit, offset: Some(2) }),
        text: "As `textureProj`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureLodOffset", params: "sampler, P, lod, offset",
        overloads: &[
            sig(G4, &[S2, F2, F1, I2]), sig(G4, &[S3, F3, F1, I3]), sig(G4, &[SA, F3, F1, I2]),
            sig(F1, &[D2, F3, F1, I2]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Exact, offset: Some(3) }),
        text: "As `textureLod`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureProjLod", params: "sampler, P, lod",
        overloads: &[
            sig(G4, &[S2, F3, F1]), sig(G4, &[S2, F4, F1]), sig(G4, &[S3, F4, F1]), sig(F1, &[D2, F4, F1]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Exact, offset: None }),
        text: "As `textureLod`, at P divided by its last component.", ..ROW },
    Row { name: "textureProjLodOffset", params: "sampler, P, lod, offset",
        overloads: &[
            sig(G4, &[S2, F3, F1, I2]), sig(G4, &[S2, F4, F1, I2]), sig(G4, &[S3, F4, F1, I3]),
            sig(F1, &[D2, F4, F1, I2]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Exact, offset: Some(3) }),
        text: "As `textureProjLod`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureGrad", params: "sampler, P, dPdx, dPdy",
        overloads: &[
            sig(G4, &[S2, F2, F2, F2]), sig(G4, &[S3, F3, F3, F3]), sig(G4, &[SC, F3, F3, F3]),
            sig(G4, &[SA, F3, F2, F2]), sig(F1, &[D2, F3, F2, F2]), sig(F1, &[DC, F4, F3, F3]),
            sig(F1, &[DA, F4, F2, F2]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Gradient, offset: None }), may_be_overloaded: true,
        text: "Filtered read at P; the level follows from the derivatives given. Hides the seam where P jumps, and \
               works in any branch.", ..ROW },
    Row { name: "textureGradOffset", params: "sampler, P, dPdx, dPdy, offset",
        overloads: &[
            sig(G4, &[S2, F2, F2, F2, I2]), sig(G4, &[S3, F3, F3, F3, I3]), sig(G4, &[SA, F3, F2, F2, I2]),
            sig(F1, &[D2, F3, F2, F2, I2]), sig(F1, &[DA, F4, F2, F2, I2]),
        ],
        operation: Sample(Form { is_projected: false, lod: Lod::Gradient, offset: Some(4) }),
        text: "As `textureGrad`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureProjGrad", params: "sampler, P, dPdx, dPdy",
        overloads: &[
            sig(G4, &[S2, F3, F2, F2]), sig(G4, &[S2, F4, F2, F2]), sig(G4, &[S3, F4, F3, F3]),
            sig(F1, &[D2, F4, F2, F2]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Gradient, offset: None }),
        text: "As `textureGrad`, at P divided by its last component; the derivatives are of the divided P.", ..ROW },
    Row { name: "textureProjGradOffset", params: "sampler, P, dPdx, dPdy, offset",
        overloads: &[
            sig(G4, &[S2, F3, F2, F2, I2]), sig(G4, &[S2, F4, F2, F2, I2]), sig(G4, &[S3, F4, F3, F3, I3]),
            sig(F1, &[D2, F4, F2, F2, I2]),
        ],
        operation: Sample(Form { is_projected: true, lod: Lod::Gradient, offset: Some(4) }),
        text: "As `textureProjGrad`, moved by a constant number of texels, -8 to 7.", ..ROW },
    // 8.9 Derivatives.
    Row { name: "dFdx", params: "p", overloads: FLOAT, operation: Derivative(Axis::X, Detail::Any), constant: Each(|_| 0.0),
        text: "How much p changes from this pixel to its neighbour on the right, by differences within 2x2 pixels. \
               Undefined in branches and loops that not all four pixels share.", ..ROW },
    Row { name: "dFdy", params: "p", overloads: FLOAT, operation: Derivative(Axis::Y, Detail::Any), constant: Each(|_| 0.0),
        text: "How much p changes from this pixel to its neighbour above, by differences within 2x2 pixels. \
               Undefined in branches and loops that not all four pixels share.", ..ROW },
    Row { name: "fwidth", params: "p", overloads: FLOAT, operation: Derivative(Axis::Width, Detail::Any), constant: Each(|_| 0.0),
        text: "abs(dFdx(p)) + abs(dFdy(p)): about how much p changes over one pixel; the width of a smooth edge.",
        ..ROW },
    // 8.9 of GLSL 4.60: queries and gathering, which GLSL ES 3.00 does not have.
    Row { name: "textureGather", params: "sampler, P, comp",
        overloads: &[
            sig(G4, &[S2, F2]), sig(G4, &[S2, F2, I1]), sig(G4, &[SA, F3]), sig(G4, &[SA, F3, I1]), sig(G4, &[SC, F3]),
            sig(G4, &[SC, F3, I1]), sig(F4, &[D2, F2, F1]), sig(F4, &[DA, F3, F1]), sig(F4, &[DC, F3, F1]),
        ],
        operation: Gather { offset: None }, since: 400,
        text: "Component comp (0 to 3, a constant; 0 without it) of the four texels that a filtered read at P mixes, not \
               filtered: those at the upper left, upper right, lower right and lower left. Of a shadow sampler, the \
               results of comparing them with the third argument.", ..ROW },
    Row { name: "textureGatherOffset", params: "sampler, P, offset, comp",
        overloads: &[
            sig(G4, &[S2, F2, I2]), sig(G4, &[S2, F2, I2, I1]), sig(G4, &[SA, F3, I2]), sig(G4, &[SA, F3, I2, I1]),
        ],
        operation: Gather { offset: Some(2) }, since: 400,
        text: "As `textureGather`, moved by a constant number of texels, -8 to 7.", ..ROW },
    Row { name: "textureQueryLevels", params: "sampler",
        overloads: &[
            sig(I1, &[S2]), sig(I1, &[S3]), sig(I1, &[SC]), sig(I1, &[SA]), sig(I1, &[D2]), sig(I1, &[DC]),
            sig(I1, &[DA]), sig(I1, &[S1]),
        ],
        operation: QueryLevels, since: 430, text: "The number of mip levels of a texture.", ..ROW },
    Row { name: "textureQueryLod", params: "sampler, P",
        overloads: &[
            sig(F2, &[S2, F2]), sig(F2, &[S3, F3]), sig(F2, &[SC, F3]), sig(F2, &[SA, F2]), sig(F2, &[D2, F2]),
            sig(F2, &[DC, F3]), sig(F2, &[DA, F2]), sig(F2, &[S1, F1]),
        ],
        operation: QueryLod, since: 400,
        text: "x: the mip level that `texture` reads at P. y: the level that follows from how fast P changes, which the \
               texture may not have. Undefined in branches that neighbours do not share.", ..ROW },
    // 8.14.1 of GLSL 4.60: derivatives of known pixels.
    Row { name: "dFdxFine", params: "p", overloads: FLOAT, operation: Derivative(Axis::X, Detail::Fine),
        constant: Each(|_| 0.0), since: 450, text: "As `dFdx`, from this pixel's own row and column.", ..ROW },
    Row { name: "dFdxCoarse", params: "p", overloads: FLOAT, operation: Derivative(Axis::X, Detail::Coarse),
        constant: Each(|_| 0.0), since: 450, text: "As `dFdx`, equal for all four pixels of 2x2.", ..ROW },
    Row { name: "dFdyFine", params: "p", overloads: FLOAT, operation: Derivative(Axis::Y, Detail::Fine),
        constant: Each(|_| 0.0), since: 450, text: "As `dFdy`, from this pixel's own row and column.", ..ROW },
    Row { name: "dFdyCoarse", params: "p", overloads: FLOAT, operation: Derivative(Axis::Y, Detail::Coarse),
        constant: Each(|_| 0.0), since: 450, text: "As `dFdy`, equal for all four pixels of 2x2.", ..ROW },
    Row { name: "fwidthFine", params: "p", overloads: FLOAT, operation: Derivative(Axis::Width, Detail::Fine),
        constant: Each(|_| 0.0), since: 450, text: "As `fwidth`, from this pixel's own row and column.", ..ROW },
    Row { name: "fwidthCoarse", params: "p", overloads: FLOAT, operation: Derivative(Axis::Width, Detail::Coarse),
        constant: Each(|_| 0.0), since: 450, text: "As `fwidth`, equal for all four pixels of 2x2.", ..ROW },
    // 8.14.2 of GLSL 4.60.
    Row { name: "interpolateAtCentroid", params: "interpolant", overloads: FLOAT, operation: Interpolate, since: 400,
        text: "A variable of an earlier stage at a place that both the pixel and the triangle cover: here the centre.",
        ..ROW },
    Row { name: "interpolateAtSample", params: "interpolant, sample", overloads: &[sig(F, &[F, I1])],
        operation: Interpolate, since: 400,
        text: "A variable of an earlier stage at a sample of the pixel: here there is one, the centre.", ..ROW },
    Row { name: "interpolateAtOffset", params: "interpolant, offset", overloads: &[sig(F, &[F, F2])],
        operation: Interpolate, since: 400,
        text: "A variable of an earlier stage at an offset, in pixels, from the centre of the pixel.", ..ROW },
    // Shadertoy's own, in Image passes: `st_assert(bool)` and `st_assert(bool, int)`, void.
    Row { name: "st_assert", params: "condition, value", overloads: &[sig(VOID, &[BOOL]), sig(VOID, &[BOOL, I1])],
        operation: Assert, is_of_image: true,
        text: "Shadertoy only, in Image: paints the picture if the condition is false: red, or red, green, blue or \
               yellow for value 0 to 3.", ..ROW },
];
