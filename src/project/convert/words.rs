//! Names that GLSL ES 3.00 or Shadertoy takes, which other programs leave to the author.

/// Shadertoy's names.
pub(super) const SHADERTOY: [&str; 24] = [
    "iResolution",
    "iTime",
    "iTimeDelta",
    "iFrame",
    "iFrameRate",
    "iMouse",
    "iDate",
    "iSampleRate",
    "iChannel0",
    "iChannel1",
    "iChannel2",
    "iChannel3",
    "iChannelTime",
    "iChannelResolution",
    "iCh0",
    "iCh1",
    "iCh2",
    "iCh3",
    "iGlobalTime",
    "st_assert",
    "mainImage",
    "mainSound",
    "mainCubemap",
    "HW_PERFORMANCE",
];

/// Words that GLSL ES 3.00 reserves, and that are names in other versions.
#[rustfmt::skip]
const RESERVED: [&str; 55] = [
    "coherent", "restrict", "readonly", "writeonly", "resource", "atomic_uint", "noperspective", "patch", "sample",
    "subroutine", "common", "partition", "active", "superp", "filter", "image1D", "image2D", "image3D", "imageCube",
    "iimage1D", "iimage2D", "iimage3D", "iimageCube", "uimage1D", "uimage2D", "uimage3D", "uimageCube", "image1DArray",
    "image2DArray", "iimage1DArray", "iimage2DArray", "uimage1DArray", "uimage2DArray", "imageBuffer", "iimageBuffer",
    "uimageBuffer", "sampler1DShadow", "sampler1DArray", "sampler1DArrayShadow", "isampler1D", "isampler1DArray",
    "usampler1D", "usampler1DArray", "sampler2DMS", "isampler2DMS", "usampler2DMS", "sampler2DMSArray",
    "isampler2DMSArray", "usampler2DMSArray", "image1DShadow", "image2DShadow", "image1DArrayShadow",
    "image2DArrayShadow", "samplerBuffer", "shared",
];

/// Words that are qualifiers in GLSL ES 3.00 before one of [`QUALIFIED`], and names elsewhere in other versions.
pub(super) const INTERPOLATION: [&str; 3] = ["flat", "smooth", "centroid"];
/// Words that may follow a qualifier of the interpolation.
pub(super) const QUALIFIED: [&str; 8] = ["in", "out", "varying", "uniform", "highp", "mediump", "lowp", "centroid"];

/// The built-in functions of GLSL ES 3.00.
#[rustfmt::skip]
const FUNCTIONS: [&str; 89] = [
    "radians", "degrees", "sin", "cos", "tan", "asin", "acos", "atan", "sinh", "cosh", "tanh", "asinh", "acosh",
    "atanh", "pow", "exp", "log", "exp2", "log2", "sqrt", "inversesqrt", "abs", "sign", "floor", "trunc", "round",
    "roundEven", "ceil", "fract", "mod", "modf", "min", "max", "clamp", "mix", "step", "smoothstep", "isnan", "isinf",
    "floatBitsToInt", "floatBitsToUint", "intBitsToFloat", "uintBitsToFloat", "packSnorm2x16", "unpackSnorm2x16",
    "packUnorm2x16", "unpackUnorm2x16", "packHalf2x16", "unpackHalf2x16", "length", "distance", "dot", "cross",
    "normalize", "faceforward", "reflect", "refract", "matrixCompMult", "outerProduct", "transpose", "determinant",
    "inverse", "lessThan", "lessThanEqual", "greaterThan", "greaterThanEqual", "equal", "notEqual", "any", "all",
    "not", "textureSize", "texture", "textureProj", "textureLod", "textureOffset", "texelFetch", "texelFetchOffset",
    "textureProjOffset", "textureLodOffset", "textureProjLod", "textureProjLodOffset", "textureGrad",
    "textureGradOffset", "textureProjGrad", "textureProjGradOffset", "dFdx", "dFdy", "fwidth",
];

/// Functions of older versions and of extensions, with those of GLSL ES 3.00 that replace them.
pub(super) const OLD_FUNCTIONS: [(&str, &str); 25] = [
    ("texture2D", "texture"),
    ("texture3D", "texture"),
    ("textureCube", "texture"),
    ("texture2DProj", "textureProj"),
    ("texture3DProj", "textureProj"),
    ("texture2DLod", "textureLod"),
    ("texture3DLod", "textureLod"),
    ("textureCubeLod", "textureLod"),
    ("texture2DLodEXT", "textureLod"),
    ("textureCubeLodEXT", "textureLod"),
    ("texture2DProjLod", "textureProjLod"),
    ("texture2DProjLodEXT", "textureProjLod"),
    ("texture2DGrad", "textureGrad"),
    ("textureCubeGrad", "textureGrad"),
    ("texture2DGradEXT", "textureGrad"),
    ("textureCubeGradEXT", "textureGrad"),
    ("texture2DGradARB", "textureGrad"),
    ("textureCubeGradARB", "textureGrad"),
    ("texture2DProjGradEXT", "textureProjGrad"),
    ("texture2DProjGradARB", "textureProjGrad"),
    ("texture2DOffset", "textureOffset"),
    ("texelFetch2D", "texelFetch"),
    ("textureSize2D", "textureSize"),
    ("dFdxFine", "dFdx"),
    ("dFdyFine", "dFdy"),
];

pub(super) fn is_reserved(name: &str) -> bool {
    RESERVED.contains(&name)
}

pub(super) fn is_function(name: &str) -> bool {
    FUNCTIONS.contains(&name)
}

/// Returns whether a function reads a texture.
pub(super) fn reads_texture(name: &str) -> bool {
    name.starts_with("texture") || name.starts_with("texelFetch")
}

/// The functions that read a row of texels by one number, by the built-in functions that they replace.
pub(super) const ONE_DIMENSIONAL: [(&str, &str, &str); 5] = [
    (
        "texture1D",
        "readRow",
        "vec4 readRow(sampler2D row, float x) { return texture(row, vec2(x, 0.5)); }\n\
         vec4 readRow(sampler2D row, float x, float bias) { return texture(row, vec2(x, 0.5), bias); }\n",
    ),
    ("texture", "readRow", ""),
    (
        "textureLod",
        "readRowLod",
        "vec4 readRowLod(sampler2D row, float x, float lod) { return textureLod(row, vec2(x, 0.5), lod); }\n",
    ),
    (
        "texelFetch",
        "fetchRow",
        "vec4 fetchRow(sampler2D row, int x, int lod) { return texelFetch(row, ivec2(x, 0), lod); }\n",
    ),
    ("textureSize", "rowSize", "int rowSize(sampler2D row, int lod) { return textureSize(row, lod).x; }\n"),
];
