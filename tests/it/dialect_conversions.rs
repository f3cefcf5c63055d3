//! Converts the programs of `tests/dialects` to Shadertoy's form, and compares their pictures with those that Eddy draws
//! of the originals. The new texts compile by the rules of GLSL ES 3.00: Eddy's, and glslang's as the site's header
//! precedes them.

use crate::{
    dialect_pictures::{Inputs, ROWS, draw_project, files_of},
    support::{gpu, programs::has_required},
};
use eddy::{
    diag::render_all,
    gpu::Gpu,
    project::{self, Overwrite, Project},
    translate,
};
use std::{fs, path::Path, process::Command};

/// By how much a channel may differ, in steps of 1/255.
const TOLERANCE: u8 = 1;

/// Programs that are not converted, with the reason, and those that are drawn differently. Each must be, so that the list
/// stays true.
const DIFFERENCES: &[(&str, &str)] = &[
    ("isf/many_targets", "a pass reads six images"),
    ("plain/arrays_of_arrays", "GLSL ES 3.00 has none"),
    ("plain/upper_left", "`gl_FragCoord` cannot be declared again"),
];

/// Returns an error unless the program is converted, compiles, and is drawn the same.
fn check(gpu: &Gpu, path: &Path) -> Result<(), String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let original = project::load(&path.display().to_string()).map_err(|e| e.to_string())?.project;
    let mut converted = translate::shadertoy(&original).map_err(|e| e.to_string())?;
    let shown = |project: &Project| {
        let texts = project.tab_sources().map(|source| format!("--- {}\n{}", source.name, source.text));
        texts.collect::<String>()
    };
    if let Ok(folder) = std::env::var("EDDY_CONVERTED") {
        fs::write(Path::new(&folder).join(path.file_name().unwrap()), shown(&converted.project)).unwrap();
    }
    if !converted.errors.is_empty() {
        return Err(render_all(&converted.errors, &converted.project.sources()));
    }
    if has_required("glslangValidator") {
        glslang(&converted.project)?;
    }
    project::leave_home(&mut converted.project, path.parent().unwrap());
    let inputs = || Inputs::of(&text).map(Inputs::pressed);
    let expected = draw_project(gpu, &original, &inputs()?)?;
    let drawn = draw_project(gpu, &converted.project, &inputs()?)?;
    let most = expected.pixels().zip(drawn.pixels()).flat_map(|(a, b)| (0..3).map(|i| a.0[i].abs_diff(b.0[i]))).max();
    match most.unwrap_or(0) {
        0..=TOLERANCE => Ok(()),
        most => Err(format!("differs by {most} of 255")),
    }
}

/// The declarations of the site before a text, without those of channels.
const HEADER: &str = "#version 300 es
precision highp float;
precision highp int;
precision mediump sampler3D;
uniform vec3 iResolution;
uniform float iTime;
uniform float iTimeDelta;
uniform float iFrameRate;
uniform int iFrame;
uniform float iChannelTime[4];
uniform vec3 iChannelResolution[4];
uniform vec4 iMouse;
uniform vec4 iDate;
uniform float iSampleRate;
out vec4 shadertoy_out_color;
void mainImage(out vec4 c, in vec2 f);
";

/// Passes each pass of the exported JSON to glslang, as the site compiles it.
fn glslang(project: &Project) -> Result<(), String> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.json");
    project::save(project, &file, Overwrite::Refuse).map_err(|e| e.to_string())?;
    let json: serde_json::Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
    let passes = json["renderpass"].as_array().unwrap();
    let code = |pass: &serde_json::Value| pass["code"].as_str().unwrap().to_owned();
    let common = passes.iter().find(|pass| pass["type"] == "common").map(code).unwrap_or_default();
    for pass in passes.iter().filter(|pass| pass["type"] != "common") {
        let channel = |n: usize| {
            let input = pass["inputs"].as_array().unwrap().iter().find(|input| input["channel"] == n);
            let ty = match input.and_then(|input| input["type"].as_str()) {
                Some("cubemap") => "samplerCube",
                Some("volume") => "sampler3D",
                _ => "sampler2D",
            };
            format!("uniform {ty} iChannel{n};\n")
        };
        let channels: String = (0..4).map(channel).collect();
        let end = "\nvoid main() { vec4 c = vec4(0.0); mainImage(c, gl_FragCoord.xy); shadertoy_out_color = c; }\n";
        let text = format!("{HEADER}{channels}{common}\n{}{end}", code(pass));
        let source = folder.path().join("a.frag");
        fs::write(&source, &text).unwrap();
        let output = Command::new("glslangValidator").arg(&source).output().unwrap();
        if !output.status.success() {
            return Err(format!("glslang: {}", String::from_utf8_lossy(&output.stdout)));
        }
    }
    Ok(())
}

#[test]
fn converted_programs_are_drawn_as_the_originals() {
    let Some(gpu) = gpu() else { return };
    let mut problems = Vec::new();
    for (dialect, extension) in ROWS {
        for path in files_of(dialect.name(), extension) {
            let name = format!("{}/{}", dialect.name(), path.file_stem().unwrap().to_string_lossy());
            let known = DIFFERENCES.iter().find(|(program, _)| *program == name);
            match (check(&gpu, &path), known) {
                (Ok(()), None) | (Err(_), Some(_)) => {}
                (Ok(()), Some(_)) => problems.push(format!("{name} agrees: remove it from DIFFERENCES")),
                (Err(problem), None) => problems.push(format!("{name}: {problem}")),
            }
        }
    }
    assert!(problems.is_empty(), "{} programs\n{}", problems.len(), problems.join("\n"));
}
