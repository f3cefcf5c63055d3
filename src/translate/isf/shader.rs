//! Concatenates the passes' texts in one fragment shader.

use super::{
    Images,
    header::is_one_input,
    reads::{Reads, without_comments},
};
use eddy_diag::{Diagnostic, SourceId, Span};
use eddy_engine::Sources;
use eddy_glsl::services::OutlineKind;
use eddy_project::{CustomUniformType, Project, directives};
use std::fmt::Write;

pub(super) struct Body {
    pub text: String,
    pub reads_mouse: bool,
}

/// Shadertoy's uniforms in terms of ISF's; those that a text names are added to it.
const UNIFORMS: [(&str, &str); 8] = [
    ("iResolution", "vec3(RENDERSIZE, 1.0)"),
    ("iTime", "TIME"),
    ("iTimeDelta", "TIMEDELTA"),
    ("iFrame", "FRAMEINDEX"),
    ("iFrameRate", "(1.0 / max(TIMEDELTA, 1e-6))"),
    ("iDate", "vec4(DATE.x, DATE.y - 1.0, DATE.zw)"),
    ("iSampleRate", "44100.0"),
    ("iMouse", "vec4(mouse, 0.0, 0.0)"),
];

/// Returns the shader, and adds errors for features that ISF cannot express.
pub(super) fn shader(project: &Project, sources: &Sources<'_>, images: &Images, found: &mut Vec<Diagnostic>) -> Body {
    let passes: Vec<usize> = (0..project.passes.len()).filter(|&i| !project.passes[i].id.is_sound()).collect();
    if passes.len() < project.passes.len() {
        found.push(Diagnostic::warning(None, "ISF has no sound: the Sound pass is left out"));
    }
    let lines = project.include_lines();
    let text_of = |id: SourceId| directives::blank(&project.inlined(id, &lines)).into_owned();
    let mut texts = String::new();
    if project.common.is_some() {
        let text = text_of(Project::COMMON_ID);
        // Common's reads must be the same in every pass; otherwise none is resolved.
        let same = passes.first().filter(|&&first| passes.iter().all(|&index| images[index] == images[first]));
        let none = Default::default();
        let (own, channels) =
            same.map_or((&none, None), |&index| (&images[index], Some(&project.passes[index].bindings)));
        let none = Default::default();
        let mut reads = Reads::new((&text, Project::COMMON_ID), own, channels.unwrap_or(&none));
        let _ = write!(texts, "// Common\n{}\n\n", reads.replaced().trim());
        found.append(&mut reads.found);
    }
    let mut entry = String::new();
    for (n, &index) in passes.iter().enumerate() {
        let pass = &project.passes[index];
        let id = Project::pass_id(index);
        let text = text_of(id);
        let mut reads = Reads::new((&text, id), &images[index], &pass.bindings);
        let body = reads.replaced();
        found.append(&mut reads.found);
        let prefix = if passes.len() > 1 { format!("{}_", pass.id.key()) } else { String::new() };
        let mut names: Vec<String> = Vec::new();
        if passes.len() > 1 {
            let analysis = sources.analyse(index);
            let outlines =
                lines.reach(id).into_iter().flat_map(|id| analysis.outline(id).into_iter().map(move |d| (id, d)));
            for (id, declared) in outlines.filter(|(_, declared)| declared.kind != OutlineKind::Macro) {
                if is_swizzle(&declared.name) {
                    let message =
                        format!("`{}` of {} may also be components of a vector", declared.name, pass.id.title());
                    let span = Span::new(id, declared.place.clone());
                    found.push(
                        Diagnostic::error(span, message)
                            .hint("rename it: in one text with the other passes its name is longer"),
                    );
                }
                if !names.contains(&declared.name) {
                    names.push(declared.name);
                }
            }
        }
        let _ = writeln!(texts, "// {}", pass.id.title());
        for name in &names {
            let _ = writeln!(texts, "#define {name} {prefix}{name}");
        }
        let _ = writeln!(texts, "{}", body.trim());
        let macros = if passes.len() > 1 { defined_macros(&text) } else { Vec::new() };
        for name in names.iter().chain(&macros) {
            let _ = writeln!(texts, "#undef {name}");
        }
        texts.push('\n');
        let alpha = if pass.id.is_image() { " color.a = 1.0;" } else { "" };
        let call = format!("{prefix}mainImage(color, gl_FragCoord.xy);{alpha}");
        let _ = match passes.len() {
            1 => writeln!(entry, "    {call}"),
            _ => writeln!(entry, "    if (PASSINDEX == {n}) {{ {call} }}"),
        };
    }
    let has = |name: &str| eddy_project::names_word(&texts, name);
    let reads_mouse = has("iMouse");
    if reads_mouse {
        found.push(Diagnostic::warning(None, "ISF has no mouse: iMouse.xy is an input of the host's, iMouse.zw are 0"));
    }
    let mut text = String::new();
    for (name, means) in UNIFORMS.iter().filter(|(name, _)| has(name)) {
        let _ = writeln!(text, "#define {name} {means}");
    }
    if has("iChannelTime") {
        let _ = writeln!(text, "#define iChannelTime float[4](TIME, TIME, TIME, TIME)");
    }
    for uniform in &sources.custom_uniforms().list {
        let name = &uniform.name;
        if uniform.ty == CustomUniformType::Color3 {
            let _ = writeln!(text, "#define {name} {name}_rgba.rgb");
        } else if !is_one_input(uniform) {
            let parts: Vec<String> =
                "xyzw".chars().take(uniform.ty.components()).map(|part| format!("{name}_{part}")).collect();
            let _ = writeln!(text, "#define {name} {}({})", uniform.ty.glsl_name(), parts.join(", "));
        }
    }
    let _ = write!(
        text,
        "\n{texts}void main() {{\n    vec4 color = vec4(0.0, 0.0, 0.0, 1.0);\n{entry}    gl_FragColor = color;\n}}\n"
    );
    Body { text, reads_mouse }
}

/// Returns whether a name can follow a dot, like components of a vector.
fn is_swizzle(name: &str) -> bool {
    let of = |set: &str| name.chars().all(|c| set.contains(c));
    name.len() <= 4 && (of("xyzw") || of("rgba") || of("stpq"))
}

/// Returns the names of the macros that a text defines, each once.
fn defined_macros(text: &str) -> Vec<String> {
    let code = String::from_utf8(without_comments(text)).unwrap_or_default();
    let mut names: Vec<String> = Vec::new();
    for line in code.lines() {
        let name = line.trim_start().strip_prefix('#').and_then(|rest| rest.trim_start().strip_prefix("define"));
        let Some(name) = name.filter(|rest| rest.starts_with([' ', '\t'])) else { continue };
        let name = name.trim_start();
        let end = name.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(name.len());
        if !name[..end].is_empty() && !names.iter().any(|known| *known == name[..end]) {
            names.push(name[..end].to_owned());
        }
    }
    names
}
