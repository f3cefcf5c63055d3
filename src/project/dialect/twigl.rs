//! The text around a file of twigl: its modes geeker and geekest declare the uniforms, and geekest the entry point.

use super::samplers::DeclaredUniform;
use crate::words::all_words;
use std::collections::HashSet;

/// The functions and constants of the mode geekest.
const GEEKEST: &str = include_str!("geekest.glsl");

/// The uniforms that the modes geeker and geekest declare.
const UNIFORMS: [(&str, &str); 5] = [("vec2", "r"), ("vec2", "m"), ("float", "t"), ("float", "f"), ("float", "s")];

/// The samplers that they declare.
const SAMPLERS: [&str; 3] = ["b", "b0", "b1"];

/// The outputs that they declare for GLSL ES 3.00, with their locations.
const OUTPUTS: [(&str, u32); 3] = [("o", 0), ("o0", 0), ("o1", 1)];

/// Returns the text of a pass that includes a file and draws one of its outputs.
pub(super) fn text(file: &str, uniforms: &[DeclaredUniform], include: &str, output: usize) -> String {
    let words = all_words(file);
    let mut text = String::new();
    for (ty, name) in UNIFORMS.into_iter().filter(|(_, name)| is_implied(name, &words, uniforms)) {
        text.push_str(&format!("uniform {ty} {name};\n"));
    }
    let samplers = SAMPLERS.into_iter().filter(|name| is_implied_sampler(name, file, &words, uniforms));
    samplers.for_each(|name| text.push_str(&format!("uniform sampler2D {name};\n")));
    let is_declared = |name: &str| declares_output(file, name);
    for (name, location) in OUTPUTS.into_iter().filter(|(name, _)| words.contains(name) && !is_declared(name)) {
        text.push_str(&format!("layout(location = {location}) out vec4 {name};\n"));
    }
    let has_main = words.contains("main");
    if !has_main || NAMES.into_iter().any(|name| is_implied(name, &words, uniforms) && !defines(file, name)) {
        text.push_str(GEEKEST);
    }
    let call = match (has_main, output) {
        (true, 0) => return text + include,
        (true, _) => {
            text.push_str(&format!("#define main twigl_main\n{include}#undef main\n"));
            "    twigl_main();\n"
        }
        (false, _) => include,
    };
    let outputs = ["o", "outColor"].into_iter().find(|name| words.contains(&*format!("{name}{output}")));
    let shown = outputs.filter(|_| output > 0).map_or(String::new(), |name| format!("    {name}0 = {name}{output};\n"));
    text + &format!("void main() {{\n{call}{shown}}}\n")
}

/// Returns the text of a Sound pass that includes a sound shader. Sound is made at 44,100 samples a second, in one block.
pub(super) fn sound_text(file: &str, include: &str) -> String {
    let words = all_words(file);
    let constants = [("sampleRate", "44100.0"), ("blockOffset", "0.0")];
    let mut text = String::new();
    for (name, value) in constants.into_iter().filter(|(name, _)| words.contains(name)) {
        text.push_str(&format!("const float {name} = {value};\n"));
    }
    text + &format!(
        "#define mainSound twigl_mainSound\n{include}#undef mainSound\n\n\
         vec2 mainSound(int samp, float time) {{\n    return twigl_mainSound(time);\n}}\n"
    )
}

/// The text of the Image pass beside a sound shader.
pub(super) const BLACK: &str = "\
// The file is a sound shader: it has no picture.
void mainImage(out vec4 color, in vec2 at) {
    color = vec4(0.0, 0.0, 0.0, 1.0);
}
";

/// The names of [`GEEKEST`] that texts use.
const NAMES: [&str; 14] = [
    "FC",
    "F4",
    "PI",
    "PI2",
    "rotate2D",
    "rotate3D",
    "hsv",
    "snoise2D",
    "snoise3D",
    "snoise4D",
    "fsnoise",
    "fsnoiseDigits",
    "permute",
    "mod289",
];

/// Returns whether a text defines a name as a macro, a function or a constant.
fn defines(file: &str, name: &str) -> bool {
    let mut words = file.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    let mut before = "";
    words.any(|word| {
        let is_definition =
            word == name && ["define", "float", "vec2", "vec3", "vec4", "mat2", "mat3"].contains(&before);
        before = word;
        is_definition
    })
}

/// Returns the samplers that a text reads without declaring them.
pub(super) fn implied_samplers(file: &str, uniforms: &[DeclaredUniform]) -> Vec<DeclaredUniform> {
    let words = all_words(file);
    let names = SAMPLERS.into_iter().filter(|name| is_implied_sampler(name, file, &words, uniforms));
    let sampler = |name: &str| DeclaredUniform {
        ty: "sampler2D".into(),
        name: name.into(),
        is_array: false,
        comment: String::new(),
        at: 0,
    };
    names.map(sampler).collect()
}

/// Returns whether a text uses a name that it does not declare. A text with `uniform` declarations is of the modes
/// classic and geek, which declare all of them.
fn is_implied(name: &str, words: &HashSet<&str>, uniforms: &[DeclaredUniform]) -> bool {
    words.contains(name) && uniforms.iter().all(|uniform| SAMPLERS.contains(&&*uniform.name))
}

/// Returns whether a text reads a sampler that it does not declare. `b` is a usual name of variables, too.
fn is_implied_sampler(name: &str, file: &str, words: &HashSet<&str>, uniforms: &[DeclaredUniform]) -> bool {
    let reads = ["texture(", "texture2D(", "texelFetch(", "textureLod(", "textureSize("];
    let is_read = reads.iter().any(|read| file.contains(&format!("{read}{name},")));
    is_implied(name, words, uniforms) && is_read
}

fn declares_output(file: &str, name: &str) -> bool {
    let mut words = file.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| !word.is_empty());
    let mut before = ["", "", ""];
    words.any(|word| {
        let is_output = word == name && (before[1] == "out" || before[0] == "out" && before[1].ends_with('p'));
        before = [before[1], before[2], word];
        is_output
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dialect::samplers::declared_uniforms;

    #[test]
    fn each_mode_gets_what_it_does_not_declare() {
        let of = |file: &str| text(file, &declared_uniforms(file), "#include \"a\"\n", 0);
        let geek = "uniform vec2 r; uniform float t; out vec4 o; void main() { o = vec4(t); }";
        assert_eq!(of(geek), "#include \"a\"\n");
        let geeker = "void main() { gl_FragColor = vec4(gl_FragCoord.xy / r, t, 1.0) + texture2D(b, m); }";
        let declared = "uniform vec2 r;\nuniform vec2 m;\nuniform float t;\nuniform sampler2D b;\n#include \"a\"\n";
        assert_eq!(of(geeker), declared);
        let geekest = of("vec2 p = FC.xy / r; o = vec4(p, fract(t), 1);");
        assert!(geekest.starts_with("uniform vec2 r;\nuniform float t;\nlayout(location = 0) out vec4 o;\n"));
        assert!(geekest.contains("#define FC gl_FragCoord") && geekest.ends_with("void main() {\n#include \"a\"\n}\n"));
        let multiple = of("o0 = texture(b0, FC.xy / r); o1 = vec4(1);");
        assert!(multiple.contains("layout(location = 1) out vec4 o1;") && multiple.contains("uniform sampler2D b0;"));
    }
}
