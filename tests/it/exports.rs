//! A project is exported from an open session as Shadertoy JSON: what is lost is named first, nothing is replaced
//! unasked, and what is read back draws the same picture.

use crate::support::{self, stage::*};
use eddy::{
    engine::BuildOptions,
    gpu::Gpu,
    media,
    playback::{npy, offline::Offline, script::ScriptedInputs},
    project::{self, PassName},
    session::{Answer, FileCommand, Level, Question},
};
use std::{fs, path::Path};

const MANIFEST: &str = "eddy = 1\n[uniforms]\nlevel = 0.25\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n\
                        [passes.image]\nchannels.0 = { buffer = \"A\" }\n";
const COMMON: &str = "#include \"util.glsl\"\n#iUniform float level = 0.5 in { 0.0, 1.0 }\n";
const UTIL: &str = "float twice(float x) { return 2.0 * x; }\n";
const BUFFER: &str = "void mainImage(out vec4 o, in vec2 p) {
    o = fract(texelFetch(iChannel0, ivec2(p), 0) + vec4(level, twice(p.x * 0.01), iTime, 1.0));
}";
const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";

fn whole(gpu: Gpu) -> Stage {
    let files = [
        ("eddy.toml", MANIFEST),
        ("common.glsl", COMMON),
        ("util.glsl", UTIL),
        ("buffer_a.glsl", BUFFER),
        ("image.glsl", IMAGE),
    ];
    let stage = Stage::open(gpu, &files);
    assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
    stage
}

/// Returns the picture of the fifth frame.
fn picture(gpu: &Gpu, spec: &Path) -> Vec<u8> {
    let loaded = project::load(spec.to_str().unwrap()).unwrap().project;
    let (media, _) = media::gather(&loaded, None);
    let mut offline = Offline::new(gpu, (40, 24), ScriptedInputs::new(60.0)).unwrap();
    offline.build(&loaded, &media, &BuildOptions::default()).unwrap();
    for _ in 0..5 {
        offline.draw().unwrap();
    }
    let mut bytes = Vec::new();
    npy::write(&mut bytes, &offline.read(&PassName::image(), 0).unwrap()).unwrap();
    bytes
}

fn lost(stage: &Stage) -> (bool, Vec<String>) {
    match stage.session.question() {
        Some(Question::Export { exists, lost, .. }) => (*exists, lost.clone()),
        other => panic!("{other:?}; {:?}", stage.session.notices()),
    }
}

#[test]
fn an_export_names_what_is_lost_and_read_back_draws_the_same_picture() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = whole(gpu.clone());
    let file = stage.dir.path().join("out.json");
    stage.session.apply(FileCommand::ExportJson(file.clone()));
    let (exists, said) = lost(&stage);
    assert!(!exists);
    assert_eq!(
        said,
        [
            "The uniform level becomes a constant with its current value.",
            "Included files are copied into the code: util.glsl."
        ]
    );
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    assert!(!file.exists() && stage.session.question().is_none());
    // What is typed is exported, saved or not, and the project stays where it is.
    stage.edit("void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) * 0.5; }");
    let origin = stage.session.project().origin.clone();
    stage.session.apply(FileCommand::ExportJson(file.clone()));
    stage.session.apply(FileCommand::Answer(Answer::Export));
    assert_eq!(stage.count(&format!("exported {}", file.display())), 1, "{:?}", stage.session.notices());
    assert!(stage.session.is_dirty() && stage.session.project().origin == origin);
    stage.session.apply(FileCommand::Save);
    let (json, folder) = (picture(&gpu, &file), picture(&gpu, &stage.folder()));
    assert!(json == folder, "the pictures differ");
    // A control: the picture depends on what was said to be lost.
    stage.write("eddy.toml", MANIFEST.replace("0.25", "0.75"));
    assert!(picture(&gpu, &stage.folder()) != json);
}

#[test]
fn a_file_that_is_there_is_replaced_only_when_asked_for_and_kept() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.5))]);
    let file = stage.dir.path().join("out.json");
    // Nothing is lost, nothing is there: nothing is asked. The name gets its ending.
    stage.session.apply(FileCommand::ExportJson(stage.dir.path().join("out")));
    assert!(stage.session.question().is_none() && file.exists());
    fs::write(&file, "precious").unwrap();
    stage.session.apply(FileCommand::ExportJson(file.clone()));
    assert_eq!(lost(&stage), (true, Vec::new()));
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    stage.session.apply(FileCommand::Answer(Answer::Cancel));
    assert_eq!(fs::read_to_string(&file).unwrap(), "precious");
    stage.session.apply(FileCommand::ExportJson(file.clone()));
    stage.session.apply(FileCommand::Answer(Answer::Export));
    assert!(fs::read_to_string(&file).unwrap().contains("renderpass"));
    let kept = stage.dir.path().join("out.json.replaced-0001/out.json");
    assert_eq!(fs::read_to_string(kept).unwrap(), "precious");
}

#[test]
fn what_cannot_be_exported_is_refused_before_anything_is_asked() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &format!("#include \"gone.glsl\"\n{}", plain(0.5)))]);
    let file = stage.dir.path().join("out.json");
    stage.session.apply(FileCommand::ExportJson(file.clone()));
    let notices = stage.notices(Level::Error).join("\n");
    assert!(
        notices.contains("not exported: ") && notices.contains("gone.glsl") && notices.contains("image.glsl:1"),
        "{notices}"
    );
    assert!(stage.session.question().is_none() && !file.exists());
    let folder = stage.dir.path().join("folder.json");
    fs::create_dir(&folder).unwrap();
    stage.session.apply(FileCommand::ExportJson(folder));
    assert!(stage.notices(Level::Error).join("\n").contains("is a folder"), "{:?}", stage.session.notices());
}

#[test]
fn settings_pictures_and_further_buffers_are_named() {
    let mut project = project::load("feedback").unwrap().project;
    assert_eq!(project::json_losses(&project), [""; 0]);
    let buffer = project.passes.iter_mut().find(|pass| pass.id == PassName::buffer("A")).unwrap();
    buffer.settings.size = project::PassSize::Scale(0.5);
    buffer.settings.format = project::TexelFormat::Rgba16f;
    let mut channel = buffer.bindings.get(0).cloned().unwrap();
    channel.input = project::Input::texture(project::Media::File("rock.png".into()));
    buffer.bindings.set(1, Some(channel));
    let mut further = buffer.clone();
    further.id = PassName::buffer("velocity");
    further.settings = Default::default();
    further.bindings = Default::default();
    project.passes.insert(0, further);
    let said = project::json_losses(&project).join("\n");
    for sentence in [
        "The size and format of Buffer A are left out.",
        "Shadertoy has only Buffer A to D and cannot read Buffer velocity",
        "iChannel1 of Buffer A reads the image file rock.png; the channel is empty on Shadertoy",
    ] {
        assert!(said.contains(sentence), "{said}");
    }
}
