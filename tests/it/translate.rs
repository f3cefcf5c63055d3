//! Presets translated to all languages, and the results checked by compilers of these languages where installed.

use crate::support::{
    presets::preset,
    program::Bench,
    programs::{failure, has_required},
};
use eddy::{
    project::presets,
    translate::{GlslVersion, Language, StageInfo, Translation, translate},
};
use std::{path::Path, process::Command};

fn translated(name: &str, language: Language) -> Translation {
    translate(&preset(name), language).unwrap_or_else(|errors| panic!("{name} as {language}: {errors:#?}"))
}

/// Calls `check` for each shader of every preset in a language, with the bytes of its file; `check` returns an error,
/// if any.
fn each_stage(language: Language, mut check: impl FnMut(&str, &StageInfo, &[u8]) -> Option<String>) {
    let mut troubles = Vec::new();
    let mut count = 0;
    for name in presets::names() {
        let done = translated(name, language);
        let programs = done.manifest.passes.iter().flat_map(|pass| {
            pass.programs.iter().chain(pass.fills.iter().map(|fill| &fill.program)).flat_map(|program| &program.stages)
        });
        for stage in programs {
            let file = done.files.iter().find(|file| file.name == stage.entry.file).expect("each stage has a file");
            count += 1;
            if let Some(trouble) = check(name, stage, &file.bytes) {
                troubles.push(format!("{name}, {}: {trouble}", file.name));
            }
        }
    }
    assert!(count >= presets::names().len(), "{count} stages");
    assert!(troubles.is_empty(), "{language}: {} of {count}\n{}", troubles.len(), troubles.join("\n"));
}

/// Writes a shader for a compiler to read, and returns the compiler's errors, if any.
fn compiled(folder: &Path, name: &str, bytes: &[u8], command: impl FnOnce(&Path) -> Command) -> Option<String> {
    let path = folder.join(name);
    std::fs::write(&path, bytes).unwrap();
    failure(&mut command(&path))
}

/// The only language without a compiler here.
#[test]
fn every_preset_is_translated_to_msl() {
    each_stage(Language::Msl, |_, _, bytes| bytes.is_empty().then(|| "an empty file".into()));
}

#[test]
fn wgsl_of_presets_is_valid() {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    each_stage(Language::Wgsl, |_, _, bytes| {
        let text = std::str::from_utf8(bytes).unwrap();
        let module = match naga::front::wgsl::parse_str(text) {
            Ok(module) => module,
            Err(error) => return Some(error.emit_to_string(text)),
        };
        let capabilities = Capabilities::default() | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
        Validator::new(ValidationFlags::all(), capabilities).validate(&module).err().map(|e| e.emit_to_string(text))
    });
}

#[test]
fn spirv_of_presets_is_valid_for_vulkan() {
    if !has_required("spirv-val") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    each_stage(Language::Spirv, |name, stage, bytes| {
        compiled(folder.path(), &format!("{name}.{}", stage.entry.file), bytes, |path| {
            let mut command = Command::new("spirv-val");
            command.args(["--target-env", "vulkan1.1"]).arg(path);
            command
        })
    });
}

/// Returns HLSL without two constructs that Microsoft's compilers accept and glslang does not: a cast of 0 to an array,
/// and calls in the initialisers of globals, which glslang treats as recursion.
fn hlsl_for_glslang(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.lines() {
        let indented = line.trim_start();
        let zeros = |value: &str| value.starts_with('(') && value.ends_with("])0;");
        match line.split_once("] = ") {
            Some((declared, value)) if line.starts_with("static ") || zeros(value) => {
                out.push_str(declared);
                out.push_str("];");
            }
            _ => match indented.strip_prefix("return (").and_then(|rest| rest.strip_suffix(")0;")?.split_once('[')) {
                Some((ty, size)) => out.push_str(&format!("{ty} zero[{size}; return zero;")),
                None => out.push_str(line),
            },
        }
        out.push('\n');
    }
    out
}

#[test]
fn hlsl_for_glslang_changes_only_unsupported_constructs() {
    let text = "static float2 a[4] = (float2[4])0;\nfloat b[2] = (float[2])0;\nfloat c[2] = d;\nreturn (int[3])0;\n";
    let expected = "static float2 a[4];\nfloat b[2];\nfloat c[2] = d;\nint zero[3]; return zero;\n";
    assert_eq!(hlsl_for_glslang(text), expected);
}

/// Passes all shaders of a version to glslang, one call per stage: setting up its built-ins takes longer than a shader.
fn glslang(version: GlslVersion) {
    if !has_required("glslangValidator") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let mut files = [("vert", Vec::new()), ("frag", Vec::new())];
    each_stage(Language::Glsl(version), |name, stage, bytes| {
        let path = folder.path().join(format!("{name}.{}", stage.entry.file));
        std::fs::write(&path, bytes).unwrap();
        files[usize::from(stage.stage != "vertex")].1.push(path);
        None
    });
    for (kind, files) in files {
        assert!(!files.is_empty(), "no {kind}");
        let errors = failure(Command::new("glslangValidator").args(["-S", kind]).args(&files));
        assert_eq!(errors, None, "{kind}");
    }
}

#[test]
fn glsl_450_of_presets_compiles() {
    glslang(GlslVersion::Desktop450);
}

#[test]
fn glsl_330_of_presets_compiles() {
    glslang(GlslVersion::Desktop330);
}

#[test]
fn glsl_es_300_of_presets_compiles() {
    glslang(GlslVersion::Es300);
}

#[test]
fn hlsl_of_presets_compiles() {
    if !has_required("glslangValidator") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    each_stage(Language::Hlsl, |name, stage, bytes| {
        let text = hlsl_for_glslang(std::str::from_utf8(bytes).unwrap());
        compiled(folder.path(), &format!("{name}.{}", stage.entry.file), text.as_bytes(), |path| {
            let mut command = Command::new("glslangValidator");
            let kind = if stage.stage == "vertex" { "vert" } else { "frag" };
            command.args(["-D", "-V", "-S", kind, "-e", &stage.entry.entry_point, "-o"]);
            command.arg(folder.path().join("out.spv")).arg(path);
            command
        })
    });
}

/// Writes a project of two passes, a feedback buffer and a custom uniform.
fn golden_project(b: &Bench) {
    let manifest = "name = \"Golden\"\n\n[passes.buffer_a]\nformat = \"rgba16f\"\nsize = 0.5\ninitial = \"vec4(0.25)\"\n\
        channels.0 = { buffer = \"A\", filter = \"nearest\" }\n\n[passes.image]\n\
        channels.0 = { buffer = \"A\", filter = \"linear\", wrap = \"clamp\" }\n";
    b.write("p/eddy.toml", manifest);
    let text = "o = texelFetch(iChannel0, ivec2(p), 0) * 0.5 + iTimeDelta;";
    b.write("p/buffer_a.glsl", format!("void mainImage(out vec4 o, in vec2 p) {{\n    {text}\n}}\n"));
    let text = "o = texture(iChannel0, p / iResolution.xy) * gain;";
    let uniform = "#iUniform float gain = 2.0 in { 0.0, 4.0 }\n";
    b.write("p/image.glsl", format!("{uniform}void mainImage(out vec4 o, in vec2 p) {{\n    {text}\n}}\n"));
}

#[test]
fn a_small_project_matches_its_snapshots() {
    let b = Bench::new();
    golden_project(&b);
    for (language, options) in
        [("wgsl", ""), ("hlsl", ""), ("msl", ""), ("glsl", ""), ("glsl", " --glsl-version 300es")]
    {
        let out = format!("out-{language}{}", options.trim().replace(' ', ""));
        b.line(&format!("translate p --to {language} --out {out}{options}")).expect(0);
        let mut all = String::new();
        for name in b.names(&out) {
            let text = String::from_utf8(b.bytes(&format!("{out}/{name}"))).unwrap();
            all.push_str(&format!("===== {name}\n{text}\n"));
        }
        let version = format!("\"eddy\": \"{}\"", env!("CARGO_PKG_VERSION"));
        insta::assert_snapshot!(format!("translate_{out}"), all.replace(&version, "\"eddy\": \"VERSION\""));
    }
}

#[test]
fn files_are_overwritten_only_with_force() {
    let b = Bench::new();
    golden_project(&b);
    let first = b.line("translate p --to wgsl").expect(0);
    assert!(first.out.contains("p-wgsl"), "{}", first.out);
    // Writing identical files again is allowed.
    b.line("translate p --to wgsl").expect(0);
    b.write("p-wgsl/image.frag.wgsl", "mine");
    let refused = b.line("translate p --to wgsl").expect(2);
    assert!(refused.err.contains("image.frag.wgsl") && refused.err.contains("--force"), "{}", refused.err);
    assert_eq!(b.bytes("p-wgsl/image.frag.wgsl"), b"mine");
    b.line("translate p --to wgsl --force").expect(0);
    assert_ne!(b.bytes("p-wgsl/image.frag.wgsl"), b"mine");
    b.write("file", "x");
    let refused = b.line("translate p --to wgsl --out file").expect(2);
    assert!(refused.err.contains("give a folder"), "{}", refused.err);
}

#[test]
fn errors_have_exit_codes_places_and_json() {
    let b = Bench::new();
    b.image("bad.glsl", "    fragColor = vec4(nothing);");
    let line = &b.line("translate bad.glsl --to msl --json").expect(1).json()[0];
    assert_eq!((&line["status"], &line["diagnostics"][0]["line"]), (&"diagnostics".into(), &2.into()));
    assert_eq!(line["files"], serde_json::json!([]));
    assert_eq!(b.names("."), ["bad.glsl"], "a file was written");
    b.image("pack.glsl", "    fragColor = vec4(packHalf2x16(fragCoord));");
    let refused = b.line("translate pack.glsl --to glsl --glsl-version 330").expect(1);
    assert!(refused.err.contains("pack.glsl:2:") && refused.err.contains("--glsl-version 450"), "{}", refused.err);
    let line = &b.line("translate pack.glsl --to glsl --json").expect(0).json()[0];
    assert_eq!(line["language_version"], "450");
    assert!(line["files"].as_array().unwrap().contains(&"translation.json".into()), "{line}");
    let usage = b.line("translate pack.glsl --to wgsl --glsl-version 330").expect(2);
    assert!(usage.err.contains("--to glsl"), "{}", usage.err);
    b.line("translate missing --to wgsl").expect(2);
}
