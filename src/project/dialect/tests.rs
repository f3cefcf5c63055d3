use super::{Dialect, ShaderForm, regenerated};
use crate::{
    Input, Media, Overwrite, PassName, PassSize, Project, ProjectError, Side, TexelFormat, limits, load, manifest, save,
};
use std::{fs, path::Path};

fn dialect(name: &str, text: &str) -> ShaderForm {
    ShaderForm::of(Path::new(name), text)
}

fn project(text: &str) -> Project {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("a.frag"), text).unwrap();
    load(dir.path().join("a.frag").to_str().unwrap()).unwrap().project
}

fn main(declarations: &str) -> String {
    format!("{declarations}\nvoid main() {{ gl_FragColor = vec4(1.0); }}")
}

#[test]
fn programs_are_recognised_by_their_names() {
    let image = "void mainImage(out vec4 c, in vec2 p) {}";
    for (text, expected) in [
        (image.to_owned(), Dialect::Shadertoy),
        ("float noise(vec2 p) { return p.x; }".to_owned(), Dialect::Shadertoy),
        (main("uniform vec2 u_resolution;"), Dialect::GlslViewer),
        (main("uniform sampler2D u_doubleBuffer0;"), Dialect::GlslViewer),
        (main("uniform float time; uniform vec2 mouse, resolution;"), Dialect::GlslSandbox),
        (main("varying vec2 surfacePosition;"), Dialect::GlslSandbox),
        (main("#version 410 core\nuniform float fGlobalTime;"), Dialect::Bonzomatic),
        (main("uniform vec2 resolution; uniform float sound;"), Dialect::Twigl),
        (main("uniform vec2 r; uniform float t;"), Dialect::Twigl),
        ("void main() { gl_FragColor = vec4(gl_FragCoord.xy / r, t, 1.0); }".to_owned(), Dialect::Twigl),
        ("o = vec4(FC.xy / r, fract(t), 1);".to_owned(), Dialect::Twigl),
        (main(""), Dialect::Plain),
        (main("#version 300 es"), Dialect::Plain),
        (main("uniform float speed;"), Dialect::Plain),
        (main("#version 300 es\nuniform float time;"), Dialect::Plain),
        (main("varying vec2 v_texcoord; uniform sampler2D tex; uniform float time;"), Dialect::Plain),
        (main("varying vec2 v_texcoord; uniform float u_time;"), Dialect::GlslViewer),
        (main("varying vec2 v_texcoord; uniform mat3 u_normalMatrix;"), Dialect::GlslViewer),
        (main("uniform vec3 u_camera;"), Dialect::GlslViewer),
        (main("varying vec2 v_texcoord; uniform float u_amount;"), Dialect::Plain),
        // Names in comments do not count.
        (main("// u_resolution, fGlobalTime"), Dialect::Plain),
        (format!("// uniform vec2 u_resolution; void main()\n{image}"), Dialect::Shadertoy),
    ] {
        assert_eq!(dialect("a.frag", &text), ShaderForm::Program(expected), "{text}");
    }
    let sound = "vec2 mainSound(float time) { return vec2(sin(440.0 * 6.2831 * time)); }";
    assert_eq!(dialect("a.glsl", sound), ShaderForm::Program(Dialect::Twigl));
    let shadertoy = sound.replace("float time", "int samp, float time");
    assert_eq!(dialect("a.glsl", &shadertoy), ShaderForm::Program(Dialect::Shadertoy));
    assert_eq!(dialect("a.glsl", "void main() { gl_Position = vec4(0); }"), ShaderForm::PlainVertex);
    assert_eq!(dialect("a.vert.glsl", ""), ShaderForm::PlainVertex);
    assert_eq!(dialect("a.fs", "/*{}*/ void main() {}"), ShaderForm::Program(Dialect::Isf));
}

#[test]
fn macros_select_passes_of_glslviewer() {
    let project = project(
        "uniform sampler2D u_buffer0; // 64x32\nuniform sampler2D u_buffer1; // 0.5\n\
         uniform sampler2D u_doubleBuffer0;\nuniform sampler2D u_scene;\n\
         #if defined(BUFFER_0)\nvoid main() {}\n#elif defined( BUFFER_2 )\nvoid main() {}\n\
         #elif defined(DOUBLE_BUFFER_0)\nvoid main() {}\n#elif defined(POSTPROCESSING)\nvoid main() {}\n\
         #else\nvoid main() {}\n#endif\n",
    );
    let ids: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
    // The buffers are numbered without gaps.
    assert_eq!(ids, ["buffer_0", "buffer_1", "buffer_double0", "buffer_scene", "image"]);
    let sizes: Vec<PassSize> = project.passes.iter().map(|pass| pass.settings.size).collect();
    let half = PassSize::Sides(Side::Floor(0.5), Side::Floor(0.5));
    assert_eq!(sizes[..3], [PassSize::Fixed(64, 32), half, PassSize::Canvas]);
    let formats: Vec<TexelFormat> = project.passes.iter().map(|pass| pass.settings.format).collect();
    assert_eq!((formats[0], formats[3]), (TexelFormat::Rgba32f, TexelFormat::Rgba8));
    let image = &project.image().unwrap().bindings;
    let read: Vec<(&str, Option<&str>)> = image
        .names()
        .map(|(slot, name)| (name, image.get(slot).and_then(|channel| channel.input.buffer_name())))
        .collect();
    assert_eq!(read[0], ("u_buffer0", Some("0")));
    assert_eq!(read[3], ("u_scene", Some("scene")));
    assert!(project.image().unwrap().source.text.contains("#define POSTPROCESSING\n#include \"a.frag\""));
    assert_eq!(project.include_lines().missing, []);
}

#[test]
fn unsupported_passes_are_errors_at_their_line() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.frag");
    for (text, said) in [
        (format!("uniform float u_time;\n#ifdef PYRAMID_0\n#endif\n{}", main("")), "PYRAMID passes"),
        (format!("uniform float u_time;\n#if defined(FLOOD_0)\n#endif\n{}", main("")), "FLOOD passes"),
        (main("uniform float fGlobalTime;\nlayout(r32ui) uniform uimage2D computeTex;"), "Bonzomatic Compute"),
        (main(&(0..17).map(|n| format!("uniform sampler2D u_tex{n};\n")).collect::<String>()), "at most 16 textures"),
    ] {
        fs::write(&file, &text).unwrap();
        let Err(ProjectError::Invalid { diagnostics, .. }) = load(file.to_str().unwrap()) else { panic!("{text}") };
        assert!(diagnostics.len() == 1 && diagnostics[0].message.contains(said), "{diagnostics:?}");
        assert!(diagnostics[0].span.is_some_and(|span| span.start > 0), "{diagnostics:?}");
    }
}

#[test]
fn comments_name_pictures_beside_the_shader() {
    let dir = tempfile::tempdir().unwrap();
    fs::create_dir(dir.path().join("data")).unwrap();
    fs::write(dir.path().join("data/moon.png"), "").unwrap();
    let text = main(
        "uniform sampler2D u_tex0; // /data/moon.png\nuniform sampler2D u_tex1; // data/sun.png\nuniform samplerCube sky;",
    );
    fs::write(dir.path().join("a.frag"), text).unwrap();
    let project = load(dir.path().join("a.frag").to_str().unwrap()).unwrap().project;
    let image = &project.image().unwrap().bindings;
    let media = |slot| image.get(slot).and_then(|channel| channel.input.media()).unwrap();
    assert_eq!(media(0), &Media::File("data/moon.png".into()));
    assert!(matches!((media(1), media(2)), (Media::Builtin(_), Media::Builtin(_))));
}

#[test]
fn uniforms_that_the_program_does_not_set_are_sliders() {
    let project = project(&main(
        "uniform float u_time, speed; // of the waves\nuniform sampler2D u_tex0; uniform vec2 u_tex0Resolution;\n\
         uniform vec3 tint; uniform float table[3]; uniform mat3 turn; uniform bool on;",
    ));
    let sliders = project.custom_uniforms();
    let names: Vec<&str> = sliders.list.iter().map(|slider| &*slider.name).collect();
    assert_eq!(names, ["speed", "tint", "on"]);
    assert!(sliders.list.iter().all(|slider| slider.is_declared));
    assert_eq!(sliders.get("speed").unwrap().about, "of the waves");
}

#[test]
fn files_above_the_shader_and_beside_the_project_can_be_included() {
    let dir = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = dir.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    };
    write("lib/noise.glsl", "#include \"hash.glsl\"\n");
    write("lib/hash.glsl", "float hash() { return 0.5; }\n");
    write("lib/secret.txt", "");
    write("shaders/parts/a.glsl", "#include \"parts/b.glsl\"\n");
    write("shaders/parts/b.glsl", "float b() { return 0.5; }\n");
    write("shaders/a.frag", &main("#include \"../lib/noise.glsl\"\n#include \"parts/a.glsl\"\n"));
    let project = load(dir.path().join("shaders/a.frag").to_str().unwrap()).unwrap().project;
    let mut names: Vec<&str> = project.includes.iter().map(|included| &*included.source.name).collect();
    names.sort_unstable();
    assert_eq!(names, ["../lib/hash.glsl", "../lib/noise.glsl", "a.frag", "parts/a.glsl", "parts/b.glsl"]);
    assert_eq!(project.include_lines().missing, []);
    let above = "../".repeat(limits::FOLDERS_ABOVE + 1);
    for line in ["../lib/secret.txt".to_owned(), format!("{above}etc/a.glsl"), "/etc/a.glsl".to_owned()] {
        write("shaders/a.frag", &main(&format!("#include \"{line}\"")));
        let project = load(dir.path().join("shaders/a.frag").to_str().unwrap()).unwrap().project;
        let missing = project.include_lines().missing;
        assert!(missing.len() == 1 && missing[0].message.contains("out of the project's folder"), "{missing:?}");
    }
}

#[test]
fn a_folder_keeps_the_dialect_the_names_and_the_sizes() {
    let dir = tempfile::tempdir().unwrap();
    let text = "uniform sampler2D u_doubleBuffer0; // 0.5\nuniform sampler2D u_tex0;\nuniform float u_time;\n\
                #ifdef DOUBLE_BUFFER_0\nvoid main() {}\n#else\nvoid main() {}\n#endif\n";
    fs::write(dir.path().join("a.frag"), text).unwrap();
    let mut project = load(dir.path().join("a.frag").to_str().unwrap()).unwrap().project;
    let picture = Input::texture(Media::Builtin("marble".into()));
    project.image_mut().unwrap().bindings.get_mut(1).unwrap().input = picture.clone();
    let refused = save(&project, &dir.path().join("a.frag"), Overwrite::Refuse).unwrap_err();
    assert!(refused.to_string().contains("more than the text of one file"), "{refused}");
    let saved = save(&project, &dir.path().join("folder"), Overwrite::Refuse).unwrap();
    assert_eq!(saved.dialect, Dialect::GlslViewer);
    assert_eq!(saved.passes[0].settings.size, project.passes[0].settings.size);
    let bindings = &saved.image().unwrap().bindings;
    assert_eq!(bindings.names().collect::<Vec<_>>(), [(0, "u_doubleBuffer0"), (1, "u_tex0")]);
    assert_eq!(bindings.get(1).unwrap().input, picture);
    assert!(manifest::write(&saved, None, "folder", false).contains("name = \"u_tex0\""));
    assert!(saved.stateful_passes().contains(&PassName::buffer("double0")));
}

#[test]
fn passes_follow_the_text_and_keep_what_the_user_changed() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("a.frag");
    let text = "uniform vec2 u_resolution;\nuniform sampler2D u_tex0, u_tex1;\nuniform sampler2D u_buffer0; // 64x32\n\
                #ifdef BUFFER_0\n#endif\nvoid main() {}\n";
    fs::write(&file, text).unwrap();
    let opened = load(file.to_str().unwrap()).unwrap().project;
    let mut project = opened.clone();
    let chosen = Input::texture(Media::Builtin("coral".into()));
    project.passes[1].bindings.get_mut(1).unwrap().input = chosen.clone();
    let edit = |project: &mut Project, from: &str, to: &str| {
        let included = &mut project.includes[0];
        assert!(included.source.text.contains(from));
        included.source.text = included.source.text.replace(from, to).into();
        included.is_edited = true;
    };
    // The chosen picture follows its sampler to another slot, a removed sampler has none, and the size changes.
    edit(&mut project, "u_tex0, u_tex1", "u_tex1, u_tex7");
    edit(&mut project, "64x32", "16x8");
    edit(&mut project, "#ifdef BUFFER_0", "#ifdef BUFFER_0\n#elif defined(DOUBLE_BUFFER_0)");
    let now = regenerated(&project).unwrap();
    assert!(project.follow_generated(&opened, &now));
    let ids: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
    assert_eq!(ids, ["buffer_0", "buffer_double0", "image"]);
    let image = &project.image().unwrap().bindings;
    let names: Vec<_> = image.names().collect();
    assert_eq!(names, [(0, "u_tex1"), (1, "u_tex7"), (2, "u_buffer0")]);
    assert_eq!(image.get(0).map(|channel| &channel.input), Some(&chosen));
    assert_eq!(project.passes[0].settings.size, PassSize::Fixed(16, 8));
    assert!(!project.follow_generated(&now.clone(), &now));
    // A text from which nothing can be generated changes nothing.
    let mut broken = project.clone();
    edit(&mut broken, "BUFFER_0", "PYRAMID_0");
    assert!(regenerated(&broken).is_none());
    // What the file holds is saved, a chosen picture is not.
    assert!(save(&project, &file, Overwrite::Refuse).is_err());
    project.passes[2].bindings = now.image().unwrap().bindings.clone();
    let saved = save(&project, &file, Overwrite::Refuse).unwrap();
    assert_eq!(saved.passes.len(), 3);
    assert_eq!(regenerated(&opened).map(|project| project.passes.len()), Some(2));
}

#[test]
fn a_sound_shader_has_a_sound_pass() {
    let project = project("vec2 mainSound(float time) { return vec2(sin(sampleRate * time)); }\n");
    let ids: Vec<&str> = project.passes.iter().map(|pass| pass.id.key()).collect();
    assert_eq!(ids, ["sound", "image"]);
    assert!(project.passes[0].source.text.contains("const float sampleRate = 44100.0;\n#define mainSound"));
}
