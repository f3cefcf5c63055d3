//! Says what the functions of section 8.8 do: reading textures.

use super::built_in::Function;
use crate::hir::Builtin;

/// Names of the parameters and what the function does.
#[rustfmt::skip]
pub(super) fn of(builtin: Builtin) -> Function {
    use Builtin as B;
    let (params, text) = match builtin {
        B::TextureSize => ("sampler, lod", "Width and height (and depth, or number of layers) in texels of level \
                                            lod; 0 is full size. Undefined for a level that does not exist."),
        B::Texture => ("sampler, P, bias", "Filtered read at P, 0 to 1 across the texture (a direction for a cube). \
                                            The level follows from how fast P changes between pixels, so it is \
                                            undefined in branches that neighbours do not share; bias is added to it."),
        B::TextureProj => ("sampler, P, bias", "As `texture`, at P divided by its last component."),
        B::TextureLod => ("sampler, P, lod", "Filtered read at P of the given level: 0 is full size, each level halves \
                                              it. Works in any branch or loop."),
        B::TextureOffset => ("sampler, P, offset, bias", "As `texture`, moved by a constant number of texels, -8 to \
                                                          7."),
        B::TexelFetch => ("sampler, P, lod", "One texel, not filtered: P counts texels from (0, 0) at the bottom left. \
                                              Outside the texture it gives zeros, as WebGL does."),
        B::TexelFetchOffset => ("sampler, P, lod, offset", "As `texelFetch`, moved by a constant number of texels, -8 \
                                                            to 7."),
        B::TextureProjOffset => ("sampler, P, offset, bias", "As `textureProj`, moved by a constant number of texels, \
                                                              -8 to 7."),
        B::TextureLodOffset => ("sampler, P, lod, offset", "As `textureLod`, moved by a constant number of texels, -8 \
                                                            to 7."),
        B::TextureProjLod => ("sampler, P, lod", "As `textureLod`, at P divided by its last component."),
        B::TextureProjLodOffset => ("sampler, P, lod, offset", "As `textureProjLod`, moved by a constant number of \
                                                                texels, -8 to 7."),
        B::TextureGrad => ("sampler, P, dPdx, dPdy", "Filtered read at P; the level follows from the derivatives \
                                                      given. Hides the seam where P jumps, and works in any branch."),
        B::TextureGradOffset => ("sampler, P, dPdx, dPdy, offset", "As `textureGrad`, moved by a constant number of \
                                                                    texels, -8 to 7."),
        B::TextureProjGrad => ("sampler, P, dPdx, dPdy", "As `textureGrad`, at P divided by its last component; the \
                                                          derivatives are of the divided P."),
        B::TextureProjGradOffset => ("sampler, P, dPdx, dPdy, offset", "As `textureProjGrad`, moved by a constant \
                                                                        number of texels, -8 to 7."),
        // The caller has the others; the test of `docs` finds one that nobody has.
        _ => ("", ""),
    };
    Function { params, text }
}
