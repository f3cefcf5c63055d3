//! The GLSL around the text of an ISF file: the declarations of an ISF host, in terms of Shadertoy's.

use super::header::{Header, IsfInput, Kind};
use std::{collections::HashSet, fmt::Write};

/// Keywords of later versions of GLSL, which an ISF input may have as its name.
const KEYWORDS: [&str; 9] = ["smooth", "flat", "centroid", "layout", "case", "uint", "uvec2", "uvec3", "uvec4"];

/// Returns the uniform name of an input.
fn uniform_name(name: &str) -> String {
    if KEYWORDS.contains(&name) { format!("isf_{name}") } else { name.to_owned() }
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
        Kind::Image | Kind::Cube | Kind::Audio | Kind::AudioFft => String::new(),
    }
}

/// Returns the text of a pass, which includes the files; `fragment` is the fragment shader's name, `words` are those of
/// its text.
pub(super) fn pass(
    index: usize,
    images: &[String],
    (fragment, words): (&str, &HashSet<&str>),
    vertex: Option<(&str, &str)>,
) -> String {
    let mut out = format!("// Pass {index} of {fragment}, as Eddy draws it: the text of the file is included below.\n");
    let _ = writeln!(out, "const int PASSINDEX = {index};");
    // Uniforms that hosts set for each image: its rectangle in its texture in texels, and whether it is flipped.
    for name in images {
        for (ending, ty, value) in
            [("imgRect", "vec4", format!("vec4(vec2(0.0), IMG_SIZE({name}))")), ("flip", "bool", "false".to_owned())]
        {
            let uniform = format!("_{name}_{ending}");
            if vertex.is_some() || words.contains(uniform.as_str()) {
                let _ = writeln!(out, "{ty} {uniform} = {value};");
            }
        }
    }
    match vertex {
        Some((name, text)) => out.push_str(&with_vertex(name, text, fragment)),
        None => {
            let _ = write!(out, "\n#include \"{fragment}\"\n");
        }
    }
    out
}

/// Returns the text that includes a vertex and a fragment shader. A pixel has the values that the vertex shader computes
/// for the four corners of the picture, interpolated between them; `gl_Position` is ignored.
fn with_vertex(name: &str, text: &str, fragment: &str) -> String {
    let varyings = varyings(text);
    let mut calls = String::new();
    for (corner, at) in [("00", "0.0, 0.0"), ("10", "1.0, 0.0"), ("01", "0.0, 1.0"), ("11", "1.0, 1.0")] {
        let _ = write!(calls, "    isf_corner = vec2({at});\n    isf_vertexMain();\n");
        for (ty, name) in &varyings {
            let _ = writeln!(calls, "    {ty} isf_{name}_{corner} = {name};");
        }
    }
    let mut mixed = String::new();
    for (_, name) in &varyings {
        let _ = writeln!(
            mixed,
            "    {name} = mix(mix(isf_{name}_00, isf_{name}_10, isf_at.x), mix(isf_{name}_01, isf_{name}_11, isf_at.x), \
             isf_at.y);"
        );
    }
    format!(
        "\nvec2 isf_corner;\nvec4 isf_position;\n#define gl_Position isf_position\n\
         void isf_vertShaderInit() {{ isf_position = vec4(2.0 * isf_corner - 1.0, 0.0, 1.0); }}\n\
         #define vv_vertShaderInit isf_vertShaderInit\n\
         #define isf_FragNormCoord isf_corner\n#define vv_FragNormCoord isf_corner\n#define main isf_vertexMain\n\
         #include \"{name}\"\n#undef main\n#undef isf_FragNormCoord\n#undef vv_FragNormCoord\n\n\
         #define main isf_main\n#include \"{fragment}\"\n#undef main\n\n\
         void main() {{\n    vec2 isf_at = isf_FragNormCoord;\n{calls}    isf_corner = isf_at;\n    isf_vertexMain();\n\
         {mixed}    isf_main();\n}}\n"
    )
}

/// The number of outputs that are interpolated: more than hosts have (`gl_MaxVaryingVectors` is 8 to 32).
const MAX_VARYINGS: usize = 64;

/// The position in the picture, which some vertex shaders declare as their output.
const POSITIONS: [&str; 2] = ["isf_FragNormCoord", "vv_FragNormCoord"];

/// Returns the types and names of the numbers and vectors that a vertex shader outputs, the position apart. Others, such
/// as arrays, are computed for the position of the pixel.
fn varyings(text: &str) -> Vec<(&str, &str)> {
    let mut found: Vec<(&str, &str)> = Vec::new();
    for line in text.lines().map(|line| line.split("//").next().unwrap_or_default()) {
        let mut words = line.split(|c: char| c.is_whitespace() || c == ';' || c == ',').filter(|word| !word.is_empty());
        if !matches!(words.next(), Some("varying" | "out")) {
            continue;
        }
        let mut words = words.skip_while(|word| matches!(*word, "highp" | "mediump" | "lowp" | "smooth"));
        let Some(ty) = words.next().filter(|ty| matches!(*ty, "float" | "vec2" | "vec3" | "vec4")) else { continue };
        let names = words.filter(|name| name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_'));
        for name in names {
            let is_new = !POSITIONS.contains(&name) && !found.iter().any(|(_, known)| *known == name);
            if is_new && found.len() < MAX_VARYINGS {
                found.push((ty, name));
            }
        }
    }
    found
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
// The functions of an ISF host. `texture` may be the name of an image.
#define IMG_SIZE(image) vec2(textureSize(image, 0))
vec4 IMG_NORM_PIXEL(sampler2D image, vec2 at) { return texture2D(image, at); }
vec4 IMG_NORM_PIXEL(sampler2D image, vec2 at, float bias) { return texture2D(image, at, bias); }
vec4 IMG_NORM_PIXEL(samplerCube image, vec3 at) { return textureCube(image, at); }
vec4 IMG_PIXEL(sampler2D image, vec2 at) { return texture2D(image, at / IMG_SIZE(image)); }
vec4 IMG_PIXEL(sampler2D image, vec2 at, float bias) { return texture2D(image, at / IMG_SIZE(image), bias); }
#define IMG_THIS_PIXEL(image) texture2D(image, isf_FragNormCoord)
#define IMG_THIS_NORM_PIXEL(image) texture2D(image, isf_FragNormCoord)
#define IMG_NORM_THIS_PIXEL(image) texture2D(image, isf_FragNormCoord)
#define texture2DRect(image, at) IMG_PIXEL(image, at)

";
