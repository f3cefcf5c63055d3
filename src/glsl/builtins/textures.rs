//! Functions that read textures or neighbouring pixels, sections 8.8 and 8.9, and Shadertoy's own.

use super::{
    constant::Constant::Each,
    overloads::{patterns::*, sig},
    row::{Form, Lod, Operation::*, ROW, Row},
};
use crate::ir::Axis;

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
    Row { name: "dFdx", params: "p", overloads: FLOAT, operation: Derivative(Axis::X), constant: Each(|_| 0.0),
        text: "How much p changes from this pixel to its neighbour on the right, by differences within 2x2 pixels. \
               Undefined in branches and loops that not all four pixels share.", ..ROW },
    Row { name: "dFdy", params: "p", overloads: FLOAT, operation: Derivative(Axis::Y), constant: Each(|_| 0.0),
        text: "How much p changes from this pixel to its neighbour above, by differences within 2x2 pixels. \
               Undefined in branches and loops that not all four pixels share.", ..ROW },
    Row { name: "fwidth", params: "p", overloads: FLOAT, operation: Derivative(Axis::Width), constant: Each(|_| 0.0),
        text: "abs(dFdx(p)) + abs(dFdy(p)): about how much p changes over one pixel; the width of a smooth edge.",
        ..ROW },
    // Shadertoy's own, in Image passes: `st_assert(bool)` and `st_assert(bool, int)`, void.
    Row { name: "st_assert", params: "condition, value", overloads: &[sig(VOID, &[BOOL]), sig(VOID, &[BOOL, I1])],
        operation: Assert, is_of_image: true,
        text: "Shadertoy only, in Image: paints the picture if the condition is false: red, or red, green, blue or \
               yellow for value 0 to 3.", ..ROW },
];
