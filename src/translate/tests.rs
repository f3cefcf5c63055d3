//! Small projects through all writers; `tests/it/translate.rs` translates presets, and passes outputs to other
//! compilers.

use super::*;
use eddy_project::{Channel, Input, Pass, PassName, Source};

fn pass(id: PassName, text: &str) -> Pass {
    let source = Source { name: id.title(), path: None, text: text.into() };
    Pass::new(id, source)
}

/// Buffer A reads itself; Image reads Buffer A, the keyboard's number of a pixel and uniforms.
fn feedback() -> Project {
    let a = PassName::buffer("A");
    let mut buffer = pass(
        a.clone(),
        "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + iTimeDelta; }",
    );
    buffer.bindings.set(0, Some(Channel::new(Input::Pass { id: a.clone(), target: 0 })));
    let mut image = pass(
        PassName::image(),
        "void mainImage(out vec4 o, in vec2 p) { o = texture(iChannel1, p / iResolution.xy) * iTime; }",
    );
    image.bindings.set(1, Some(Channel::new(Input::Pass { id: a, target: 0 })));
    eddy_project::Project { passes: vec![buffer, image], ..Project::of_image("feedback".into(), String::new()) }
}

fn text<'t>(translation: &'t Translation, name: &str) -> &'t str {
    let file = translation.files.iter().find(|file| file.name == name);
    let file = file.unwrap_or_else(|| panic!("{name} is not there: {:?}", names(translation)));
    std::str::from_utf8(&file.bytes).expect("a text")
}

fn names(translation: &Translation) -> Vec<&str> {
    translation.files.iter().map(|file| file.name.as_str()).collect()
}

fn image(text: &str) -> Project {
    Project::of_image("test".into(), text.into())
}

#[test]
fn each_pass_has_a_file_and_bindings() {
    let project = feedback();
    for (language, extension, places) in [
        (Language::Wgsl, "wgsl", &["@group(1) @binding(2)", "@group(0) @binding(0)"][..]),
        (Language::Hlsl, "hlsl", &[": register(t1)", "iChannel1_sampler : register(s1)", ": register(b0)"]),
        (Language::Msl, "metal", &["[[texture(1)]]", "[[sampler(1)]]", "[[buffer(0)]]"]),
        (Language::Glsl(GlslVersion::Desktop450), "glsl", &["#version 450", "binding = 1", "binding = 0"]),
        (Language::Glsl(GlslVersion::Es300), "glsl", &["#version 300 es", "precision highp float"]),
        (Language::Glsl(GlslVersion::Desktop330), "glsl", &["#version 330 core", "layout(std140) uniform"]),
    ] {
        let done = translate(&project, language).unwrap_or_else(|e| panic!("{language}: {e:?}"));
        let file = |stem: &str| format!("{stem}.{extension}");
        let expected = [file("full_screen.vert"), file("buffer_a.frag"), file("image.frag"), MANIFEST.to_owned()];
        assert_eq!(names(&done), expected, "{language}");
        let text = text(&done, &file("image.frag"));
        places.iter().for_each(|place| assert!(text.contains(place), "{language}: no {place} in\n{text}"));
        assert!(!text.contains("nagaSamplerHeap"));
    }
    let spirv = translate(&project, Language::Spirv).expect("translates");
    assert!(spirv.files[..3].iter().all(|file| file.bytes.starts_with(&0x0723_0203u32.to_le_bytes())));
}

#[test]
fn manifest_describes_reads_and_their_frames() {
    let done = translate(&feedback(), Language::Wgsl).expect("translates");
    let Manifest { targets, passes, runs, .. } = &done.manifest;
    assert_eq!(targets[0].pass, "buffer_a");
    assert!(targets[0].doubled);
    assert_eq!(runs.iter().map(|run| run.passes.join(" ")).collect::<Vec<_>>(), ["buffer_a", "image"]);
    assert_eq!(passes[0].channels[0].from, ReadFrom::Target { target: 0, frame: "last" });
    assert_eq!(passes[1].channels[0].from, ReadFrom::Target { target: 0, frame: "this" });
    let uniforms = &passes[1].programs[0].stages[0].bindings[0];
    assert_eq!((uniforms.kind, uniforms.size), (BindingKind::Uniforms, Some(240)));
    let time = uniforms.members.iter().find(|member| member.name == "iTime").expect("a member");
    assert_eq!((time.ty.as_str(), time.offset), ("float", 12));
    let resolutions = uniforms.members.iter().find(|member| member.name == "iChannelResolution").expect("a member");
    assert_eq!((resolutions.ty.as_str(), resolutions.offset), ("vec3[4]", 128));
}

#[test]
fn glsl_binding_names_are_in_the_text() {
    for version in GlslVersion::ALL {
        let done = translate(&feedback(), Language::Glsl(version)).expect("translates");
        let stage = &done.manifest.passes[1].programs[0].stages[0];
        let source = text(&done, &stage.entry.file);
        assert_eq!(stage.bindings.len(), 2, "a sampler is one with its texture");
        for binding in &stage.bindings {
            let BindingSlot::Glsl { name, binding } = &binding.at else { panic!("{binding:?}") };
            assert!(source.contains(name.as_str()), "{name}\n{source}");
            assert_eq!(binding.is_some(), version == GlslVersion::Desktop450);
        }
    }
}

#[test]
fn metal_entry_point_name_matches_the_manifest() {
    let done = translate(&feedback(), Language::Msl).expect("translates");
    let entry = &done.manifest.passes[0].programs[0].stages[0].entry;
    assert_ne!(entry.entry_point, "main", "C++ has that for itself");
    assert!(text(&done, &entry.file).contains(&format!(" {}(", entry.entry_point)));
}

#[test]
fn tables_are_files_or_inlined_without_buffers() {
    // 300 matrices of floats do not fit into a uniform table; an array of vectors would.
    let elements: Vec<String> = (0..200).map(|n| format!("mat2({n}, 1, 2, 3)")).collect();
    let shader = format!(
        "const mat2 t[200] = mat2[200]({});\nvoid mainImage(out vec4 o, in vec2 p) {{ o = t[int(p.x) % 200][0].xyxy; }}",
        elements.join(", ")
    );
    let project = image(&shader);
    let table = "image.frag.storage_table.bin";
    for language in [Language::Wgsl, Language::Hlsl, Language::Msl, Language::Spirv, Language::Glsl(Default::default())]
    {
        let done = translate(&project, language).expect("translates");
        let file = done.files.iter().find(|file| file.name == table).unwrap_or_else(|| panic!("{language}"));
        assert_eq!(file.bytes.len(), 200 * 16, "{language}");
        let binding = &done.manifest.passes[0].programs[0].stages[0].bindings[0];
        assert_eq!((binding.kind, binding.contents.as_deref()), (BindingKind::StorageTable, Some(table)));
    }
    for version in [GlslVersion::Desktop330, GlslVersion::Desktop410, GlslVersion::Es300] {
        let done = translate(&project, Language::Glsl(version)).expect("translates");
        assert!(!names(&done).contains(&table), "{version:?}");
    }
}

#[test]
fn unsupported_packing_is_refused_with_its_line() {
    let project =
        image("// packHalf2x16\nvoid mainImage(out vec4 o, in vec2 p) {\n    o = vec4(float(packHalf2x16(p)));\n}");
    for version in [GlslVersion::Desktop330, GlslVersion::Desktop410] {
        let errors = translate(&project, Language::Glsl(version)).expect_err("refused");
        let [error] = &errors[..] else { panic!("{errors:?}") };
        assert!(error.message.contains("Image") && error.message.contains("`packHalf2x16`"), "{}", error.message);
        let at = project.sources().line_column(error.span.expect("a place")).expect("in the text");
        assert_eq!((at.line, at.column), (3, 20));
        assert!(error.hints[0].contains("--glsl-version 450"));
    }
    for language in Language::ALL.into_iter().chain([Language::Glsl(GlslVersion::Es300)]) {
        translate(&project, language).unwrap_or_else(|e| panic!("{language}: {e:?}"));
    }
}

#[test]
fn integer_mix_is_replaced_by_a_function() {
    let project = image("void mainImage(out vec4 o, in vec2 p) { o = vec4((ivec2(p) % int(p.x)).xyxy); }");
    for version in GlslVersion::ALL {
        let done = translate(&project, Language::Glsl(version)).expect("translates");
        let text = text(&done, "image.frag.glsl");
        let is_old = version != GlslVersion::Desktop450;
        assert_eq!(text.contains("eddy_mix(ivec2 a, ivec2 b, bvec2 t)"), is_old, "{version:?}\n{text}");
    }
}

#[test]
fn compile_errors_are_returned_unchanged() {
    let errors = translate(&image("void mainImage(out vec4 o, in vec2 p) { o = oops; }"), Language::Wgsl);
    assert!(errors.expect_err("an error")[0].message.contains("oops"));
}

#[test]
fn non_finite_numbers_are_not_constants_in_wgsl() {
    let done = translate(
        &image("void mainImage(out vec4 o, in vec2 p) { o = p.x > 3.0 ? vec4(1.0 / 0.0) : vec4(0.0); }"),
        Language::Wgsl,
    );
    let done = done.expect("translates");
    let text = text(&done, "image.frag.wgsl");
    naga::front::wgsl::parse_str(text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert!(text.starts_with("diagnostic(off, derivative_uniformity);"));
}

#[test]
fn custom_uniforms_have_offsets_and_values() {
    let project = image(
        "#iUniform float speed = 2.0 in { 0.0, 4.0 }\n#iUniform color3 tint = color3(1.0, 0.5, 0.0)\n\
         void mainImage(out vec4 o, in vec2 p) { o = vec4(tint * speed, 1.0); }",
    );
    let done = translate(&project, Language::Hlsl).expect("translates");
    let own = &done.manifest.custom_uniforms;
    assert_eq!(
        own.iter().map(|u| (u.name.as_str(), u.ty, u.offset)).collect::<Vec<_>>(),
        [("speed", "float", 0), ("tint", "color3", 16)]
    );
    assert_eq!(own[1].value, [1.0, 0.5, 0.0]);
}

#[test]
fn arrays_of_arrays_need_a_later_version_of_es() {
    let rows: Vec<String> = (0..20).map(|n| format!("{{{}}}", vec![n.to_string(); 20].join(", "))).collect();
    let shader = format!(
        "const float t[20][20] = {{{}}};\nfloat a[2][3];\n\
         void mainImage(out vec4 o, in vec2 p) {{ int i = int(p.x) % 2; a[i][i] = t[i][int(p.y)]; o = vec4(a[1][1]); }}",
        rows.join(", ")
    );
    let project = Project { dialect: eddy_project::Dialect::Plain, ..image(&shader) };
    let others = [GlslVersion::Desktop330, GlslVersion::Desktop410].map(Language::Glsl);
    for language in Language::ALL.into_iter().chain(others) {
        translate(&project, language).unwrap_or_else(|e| panic!("{language}: {e:?}"));
    }
    let errors = translate(&project, Language::Glsl(GlslVersion::Es300)).expect_err("refused");
    assert!(errors[0].message.ends_with("which has no arrays of arrays"), "{errors:?}");
}
