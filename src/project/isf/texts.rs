//! The GLSL around the text of an ISF file: the declarations of an ISF host, in terms of Shadertoy's.

use super::header::{Header, IsfInput, Kind};
use crate::words::all_words;
use std::{collections::HashSet, fmt::Write};

/// Names that Eddy or GLSL ES reserves, but that an ISF input may have.
const TAKEN: [&str; 52] = [
    "iResolution",
    "iTime",
    "iTimeDelta",
    "iFrame",
    "iFrameRate",
    "iMouse",
    "iDate",
    "iSampleRate",
    "iChannelTime",
    "iChannelResolution",
    "iChannel0",
    "iChannel1",
    "iChannel2",
    "iChannel3",
    "iGlobalTime",
    "mix",
    "step",
    "distance",
    "length",
    "radians",
    "degrees",
    "sign",
    "smooth",
    "flat",
    "inverse",
    "round",
    "min",
    "max",
    "abs",
    "floor",
    "ceil",
    "fract",
    "mod",
    "clamp",
    "pow",
    "exp",
    "log",
    "sqrt",
    "sin",
    "cos",
    "tan",
    "dot",
    "cross",
    "normalize",
    "reflect",
    "refract",
    "smoothstep",
    "any",
    "all",
    "not",
    "transpose",
    "trunc",
];

/// Returns the uniform name of an input.
fn uniform_name(name: &str) -> String {
    if TAKEN.contains(&name) { format!("isf_{name}") } else { name.to_owned() }
}

/// Returns Common: the built-ins of ISF, and the inputs as sliders.
pub(super) fn common(header: &Header) -> String {
    let mut out = String::from(BUILT_INS);
    for input in header.inputs.iter().filter(|input| !input.kind.is_image()) {
        let name = uniform_name(&input.name);
        if name != input.name {
            let _ = writeln!(out, "#define {} {name}", input.name);
        }
        let _ = writeln!(out, "{}", declaration(&name, input));
    }
    out
}

/// The `#iUniform` line of an input.
fn declaration(name: &str, input: &IsfInput) -> String {
    let about = if input.label.is_empty() { String::new() } else { format!(" // {}", input.label) };
    let at = |list: &[f64], i: usize| list.get(i).copied().filter(|x| x.is_finite());
    let first = |list: &[f64]| at(list, 0);
    let vector = |ty: &str, count: usize, list: &[f64], missing: f64| {
        let all: Vec<String> = (0..count).map(|i| format!("{:?}", at(list, i).unwrap_or(missing))).collect();
        format!("{ty}({})", all.join(", "))
    };
    match input.kind {
        Kind::Event => format!("#iUniform bool {name} = false{about}"),
        Kind::Bool => format!("#iUniform bool {name} = {}{about}", first(&input.default).is_some_and(|x| x > 0.5)),
        Kind::Long => {
            let all = || input.values.iter().copied().filter(|x| x.is_finite());
            let least = all().reduce(f64::min).or(first(&input.min));
            let most = all().reduce(f64::max).or(first(&input.max));
            let default = first(&input.default).or(least).unwrap_or(0.0).round();
            match least.zip(most).filter(|(least, most)| least < most) {
                Some((least, most)) => {
                    let (least, most) = (least.round(), most.round());
                    format!("#iUniform int {name} = {} in {{ {least}, {most} }}{about}", default.clamp(least, most))
                }
                None => format!("#iUniform int {name} = {default}{about}"),
            }
        }
        Kind::Float => {
            let range = first(&input.min).zip(first(&input.max)).filter(|(min, max)| min < max);
            let default = first(&input.default).or(range.map(|(min, _)| min)).unwrap_or(0.0);
            match range {
                // Hosts accept a default outside the range.
                Some((min, max)) => {
                    let (min, max) = (min.min(default), max.max(default));
                    format!("#iUniform float {name} = {default:?} in {{ {min:?}, {max:?} }}{about}")
                }
                None => format!("#iUniform float {name} = {default:?}{about}"),
            }
        }
        Kind::Point2D => {
            let range = first(&input.min).zip(first(&input.max)).filter(|(min, max)| min < max);
            let default = vector("vec2", 2, &input.default, 0.0);
            let low = |i: usize| at(&input.default, i).unwrap_or(0.0);
            match range {
                Some((min, max)) => {
                    let (min, max) = (min.min(low(0)).min(low(1)), max.max(low(0)).max(low(1)));
                    format!("#iUniform vec2 {name} = {default} in {{ {min:?}, {max:?} }}{about}")
                }
                None => format!("#iUniform vec2 {name} = {default}{about}"),
            }
        }
        Kind::Color => {
            let missing = if input.default.is_empty() { 1.0 } else { 0.0 };
            let mut values = input.default.clone();
            if values.len() == 3 {
                values.push(1.0);
            }
            let clamped: Vec<f64> = values.iter().map(|x| x.clamp(0.0, 1.0)).collect();
            format!("#iUniform vec4 {name} = {} in {{ 0.0, 1.0 }}{about}", vector("vec4", 4, &clamped, missing))
        }
        Kind::Image | Kind::Audio | Kind::AudioFft => String::new(),
    }
}

/// Properties of a text that all its passes need, computed once.
pub(super) struct TextWords<'t> {
    pub words: HashSet<&'t str>,
    /// The text has an entry point of Shadertoy's that it calls itself. If a macro renames it, as in exported files, it
    /// needs no other name.
    has_main_image: bool,
}

impl<'t> TextWords<'t> {
    pub(super) fn of(text: &'t str) -> Self {
        let words = all_words(text);
        let defines = |line: &str| {
            line.trim_start().strip_prefix("#define").is_some_and(|rest| rest.trim_start().starts_with("mainImage"))
        };
        let has_main_image = words.contains("mainImage") && !text.lines().any(defines);
        Self { words, has_main_image }
    }
}

/// Returns the text of a pass: binds `images` to channels and includes the files; `of` describes the fragment shader's
/// text.
pub(super) fn pass(
    index: usize,
    images: &[String],
    (fragment, of): (&str, &TextWords<'_>),
    vertex: Option<&str>,
) -> String {
    let mut out = format!("// Pass {index} of {fragment}, as Eddy draws it: the text of the file is included below.\n");
    let _ = writeln!(out, "const int PASSINDEX = {index};");
    for (channel, name) in images.iter().enumerate().filter(|(n, name)| **name != format!("iChannel{n}")) {
        let _ = writeln!(out, "#define {name} iChannel{channel}");
    }
    // Uniforms that hosts set for each image: its rectangle in its texture in texels, its size, and whether it is
    // flipped.
    for (channel, name) in images.iter().enumerate() {
        for (ending, value) in [
            ("imgRect", format!("vec4(vec2(0.0), IMG_SIZE(iChannel{channel}))")),
            ("imgSize", format!("IMG_SIZE(iChannel{channel})")),
            ("flip", "false".to_owned()),
        ] {
            let uniform = format!("_{name}_{ending}");
            if of.words.contains(uniform.as_str()) {
                let _ = writeln!(out, "#define {uniform} {value}");
            }
        }
    }
    // The output array is the older form of the single colour (GLSL 1.20, section 7.2).
    let has_outputs = of.words.contains("gl_FragData");
    if has_outputs {
        out.push_str("vec4 isf_FragData[1];\n#define gl_FragData isf_FragData\n");
    }
    // A function of the text may have the same name as the entry point below.
    if of.has_main_image {
        out.push_str("#define mainImage isf_mainImage\n");
    }
    if let Some(vertex) = vertex {
        let _ = write!(out, "\n#define main isf_vertexMain\n#include \"{vertex}\"\n#undef main\n");
    }
    let _ = write!(out, "\n#define main isf_main\n#include \"{fragment}\"\n#undef main\n\n");
    if of.has_main_image {
        out.push_str("#undef mainImage\n");
    }
    out.push_str("void mainImage(out vec4 isf_color, in vec2 isf_at) {\n");
    if vertex.is_some() {
        out.push_str("    isf_vertexMain();\n");
    }
    let color = if has_outputs { "isf_FragData[0]" } else { "isf_FragColor" };
    let _ = write!(out, "    isf_main();\n    isf_color = {color};\n}}\n");
    out
}

/// Returns the text of a buffer that converts the sound texture in channel 0 to the image of an audio input:
/// Shadertoy's texture has the spectrum in its lower row and the wave in its upper one.
pub(super) fn audio(kind: Kind) -> String {
    let (row, what) = if kind == Kind::AudioFft { (0.25, "spectrum") } else { (0.75, "wave") };
    format!(
        "// The {what} of the sound, as an image of ISF.\n\
         void mainImage(out vec4 color, in vec2 at) {{\n\
         \x20   color = vec4(texture(iChannel0, vec2(at.x / iResolution.x, {row:?})).rrr, 1.0);\n}}\n"
    )
}

/// The text of an Image pass that shows a buffer in channel 0.
pub(super) const SHOW: &str = "\
// The last pass of the ISF file draws a buffer, which is shown.
void mainImage(out vec4 color, in vec2 at) {
    color = texture(iChannel0, at / iResolution.xy);
}
";

/// The text of a buffer that makes an image of the resolution of the picture from the one in channel 0.
pub(super) const SCALED: &str = "\
// The image at the resolution of the picture. Choose another image in iChannel0 of this buffer.
void mainImage(out vec4 color, in vec2 at) {
    color = texture(iChannel0, at / iResolution.xy);
}
";

const BUILT_INS: &str = "\
// What an ISF host puts before a shader, in terms of Shadertoy's uniforms.
// Variables, so that macros, parameters and members may have their names.
float TIME = iTime;
float TIMEDELTA = iTimeDelta;
int FRAMEINDEX = iFrame;
vec4 DATE = vec4(iDate.x, iDate.y + 1.0, iDate.zw);
vec2 RENDERSIZE = iResolution.xy;
vec2 isf_FragNormCoord = gl_FragCoord.xy / iResolution.xy;
#define vv_FragNormCoord isf_FragNormCoord
#define IMG_SIZE(image) vec2(textureSize(image, 0))
#define IMG_NORM_PIXEL texture
vec4 IMG_PIXEL(sampler2D image, vec2 at) { return texture(image, at / IMG_SIZE(image)); }
vec4 IMG_PIXEL(sampler2D image, vec2 at, float bias) { return texture(image, at / IMG_SIZE(image), bias); }
#define IMG_THIS_PIXEL(image) texture(image, isf_FragNormCoord)
#define IMG_THIS_NORM_PIXEL(image) texture(image, isf_FragNormCoord)
#define IMG_NORM_THIS_PIXEL(image) texture(image, isf_FragNormCoord)
#define texture2D texture
#define texture2DProj textureProj
#define texture2DLod textureLod
#define texture2DLodEXT textureLod
#define texture2DProjLod textureProjLod
#define texture2DProjLodEXT textureProjLod
#define texture2DGradEXT textureGrad
#define texture2DProjGradEXT textureProjGrad
#define texture2DRect(image, at) IMG_PIXEL(image, at)
vec4 isf_FragColor;
#define gl_FragColor isf_FragColor

// Of its vertex shader, which is called for each pixel.
#define varying
vec4 isf_position;
#define gl_Position isf_position
void isf_vertShaderInit() { isf_position = vec4(2.0 * isf_FragNormCoord - 1.0, 0.0, 1.0); }
#define vv_vertShaderInit isf_vertShaderInit

";
