//! Passes that draw meshes, as files: read, written, checked, refused and reloaded.

use crate::support::{self, program::Bench, stage::Stage};
use eddy::{
    project::{self, Input, MeshSource, Overwrite, PassName, Stage as Text, Tab, TexelFormat},
    session::{Command, EditCommand, FileCommand, Level, TransportCommand},
};
use std::{fs, path::Path};

const TOML: &str = concat!(
    r#"eddy = 1
name = "scene"

[passes.buffer_scene]
targets = ["rgba8", "rgba16f"]    # colour, normal
size = [8, 4]
channels.0 = { texture = "noise-rgba-64" }
camera = { yaw = 45, distance = 6.5, target = [0, 0.5, 0] }
draw = [
  { mesh = "models/tri.obj", vertex = "scene.vert.glsl", fragment = "scene.frag.glsl", cull = "none" },   # the body
  { mesh = "builtin:cube", vertex = "hull.vert.glsl", fragment = "scene.frag.glsl", cull = "front", "#,
    r#"depth = "less_equal", depth_write = false, color_write = false, "#,
    r#"scale = 2, rotation = [0, 90, 0], position = [0, 1.5, 0] },
]

[passes.image]
channels.0 = { buffer = "scene", target = 1, filter = "nearest" }
channels.1 = { buffer = "scene" }
"#
);

const VERTEX: &str =
    "in vec3 aPosition;\nout vec3 vAt;\nvoid main() { vAt = aPosition; gl_Position = vec4(aPosition, 1.0); }\n";
const HULL: &str = "in vec3 aPosition;\nout vec3 vAt;\nvoid main() { vAt = aPosition; gl_Position = iProjection * \
                    iView * iModel * vec4(aPosition, 1.0); }\n";
const FRAGMENT: &str = "in vec3 vAt;\nlayout(location = 0) out vec4 a;\nlayout(location = 1) out vec4 b;\n\
    void main() { a = vec4(0.2, 0.0, 0.0, 1.0); b = vec4(vAt, 1.0); }\n";
const SHOW: &str = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel1, ivec2(p), 0); }\n";
/// Covers the lower left of the picture, and faces away.
const TRIANGLE: &str = "v -1 -1 0\nv 3 -1 0\nv -1 3 0\nf 1 3 2\n";

fn files() -> [(&'static str, &'static str); 6] {
    [
        ("eddy.toml", TOML),
        ("scene.vert.glsl", VERTEX),
        ("hull.vert.glsl", HULL),
        ("scene.frag.glsl", FRAGMENT),
        ("image.glsl", SHOW),
        ("models/tri.obj", TRIANGLE),
    ]
}

fn write(folder: &Path, changes: &[(&str, &str)]) {
    fs::create_dir_all(folder.join("models")).unwrap();
    for (name, text) in files().iter().chain(changes) {
        fs::write(folder.join(name), text).unwrap();
    }
}

fn scene_tab(file: &str) -> Tab {
    Tab::Stage(PassName::buffer("scene"), file.into())
}

#[test]
fn a_folder_is_read_and_written_back_as_it_was() {
    let dir = tempfile::tempdir().unwrap();
    let home = dir.path().join("scene");
    write(&home, &[]);
    let loaded = project::load(home.to_str().unwrap()).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
    let mut p = loaded.project;
    let pass = &p.passes[0];
    assert_eq!(pass.formats(), [TexelFormat::Rgba8, TexelFormat::Rgba16f]);
    let g = pass.body.geometry().unwrap();
    assert_eq!(p.passes[0].source.name, "scene.frag.glsl");
    assert_eq!((g.draws[0].vertex, g.draws[0].fragment), (Text::File(0), Text::Own));
    assert_eq!((g.draws[1].vertex, g.draws[1].fragment), (Text::File(1), Text::Own));
    assert_eq!(g.draws[0].mesh, MeshSource::File("models/tri.obj".into()));
    assert_eq!((g.camera.yaw, g.camera.pitch, g.camera.distance), (45.0, 20.0, 6.5));
    assert_eq!(p.passes[1].bindings.get(0).unwrap().input, Input::Pass { id: PassName::buffer("scene"), target: 1 });
    let titles: Vec<String> = p.tabs().iter().map(Tab::title).collect();
    assert_eq!(titles, ["Buffer scene", "scene.vert.glsl", "hull.vert.glsl", "Image"]);
    for (id, source) in p.sources().iter().skip(1) {
        assert_eq!(p.source(&p.tab_of(id).unwrap()), Some(&p.source(&p.tab_of(id).unwrap()).unwrap().clone()));
        assert_eq!(p.source(&p.tab_of(id).unwrap()).unwrap().name, source.name);
    }

    project::save(&p, &home, Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(home.join("eddy.toml")).unwrap(), TOML, "nothing was changed");

    // A change of one thing leaves the rest as it is written, comments too.
    p.passes[0].body.geometry_mut().unwrap().camera.yaw = 10.0;
    p.source_mut(&scene_tab("hull.vert.glsl")).unwrap().text = "// hull\n".into();
    project::save(&p, &home, Overwrite::Refuse).unwrap();
    let text = fs::read_to_string(home.join("eddy.toml")).unwrap();
    assert_eq!(text, TOML.replace("yaw = 45", "yaw = 10.0"));
    assert_eq!(fs::read_to_string(home.join("hull.vert.glsl")).unwrap(), "// hull\n");

    // Elsewhere: stages, models, all of it.
    p.passes[0].body.geometry_mut().unwrap().draws[0].normals = Some(project::Normals::Flat);
    p.passes[0].body.geometry_mut().unwrap().draws[0].cull = project::Cull::Front;
    let away = dir.path().join("away");
    let saved = project::save(&p, &away, Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(away.join("models/tri.obj")).unwrap(), TRIANGLE);
    let read = project::load(away.to_str().unwrap()).unwrap().project;
    assert_eq!(read.passes, saved.passes);
    assert!(fs::read_to_string(away.join("eddy.toml")).unwrap().contains("normals = \"flat\", cull = \"front\""));
    let bare = |p: &project::Project| {
        let mut p = p.clone();
        p.tab_sources_mut().into_iter().for_each(|s| (s.name, s.path) = (String::new(), None));
        p.passes
    };
    assert_eq!(bare(&read), bare(&p));
}

#[test]
fn mistakes_in_the_file_are_told_at_their_place() {
    let dir = tempfile::tempdir().unwrap();
    let camera = "camera = { yaw = 45, distance = 6.5, target = [0, 0.5, 0] }";
    for (from, to, says) in [
        ("cull = \"none\"", "cul = \"none\"", "draw 0 has no key cul\n  --> eddy.toml:10:"),
        ("cull = \"none\"", "cull = \"bac\"", "unknown cull \"bac\""),
        ("cull = \"none\"", "normals = \"smoth\"", "unknown normals \"smoth\""),
        ("cull = \"front\"", "normals = \"flat\"", "a builtin mesh has its own normals"),
        ("cull = \"none\"", "depth = \"closer\"", "unknown depth \"closer\""),
        ("mesh = \"models/tri.obj\", ", "", "draw 0 has no mesh"),
        ("vertex = \"scene.vert.glsl\", ", "", "draw 0 has no vertex"),
        ("\"scene.vert.glsl\"", "\"scen.vert.glsl\"", "did you mean scene.vert.glsl?"),
        ("\"rgba16f\"]", "\"rgba16\"]", "targets is an array, not a list of one to 4 of the formats"),
        (camera, "camera = { yow = 45 }", "did you mean yaw?"),
        (camera, "camera = { near = 5, far = 1 }", "the far plane is in front of the near plane"),
        (camera, "camera = { pitch = 95 }", "pitch is an integer, not degrees from -89 to 89"),
        (camera, "format = \"rgba8\"", "the formats of this pass are in targets"),
        (camera, "region = [0, 0, 1, 1]", "has no region"),
        (camera, "file = \"image.glsl\"", "no draw uses this pass's own file"),
        ("scale = 2", "scale = 0", "scale is an integer, not a number above 0"),
        ("position = [0, 1.5, 0]", "position = [0, 1.5]", "three numbers"),
        ("target = 1", "target = 2", "reads target 2 of Buffer scene, which has targets 0 to 1"),
        ("target = 1", "target = -1", "a whole number from 0 to 3"),
        ("[passes.image]", "[passes.image]\ndraw = []", "Image draws no meshes"),
        ("[passes.image]", "[passes.image]\ncamera = {}", "camera is for passes that draw meshes"),
    ] {
        let text = TOML.replacen(from, to, 1);
        assert_ne!(text, TOML, "{from}");
        write(dir.path(), &[("eddy.toml", &text)]);
        let error = project::load(dir.path().to_str().unwrap()).expect_err(to).to_string();
        assert!(error.contains(says), "{to}\n{error}");
        assert!(error.contains("= help: "), "{error}");
    }
}

#[test]
fn tables_of_their_own_say_the_same_as_a_list() {
    let dir = tempfile::tempdir().unwrap();
    let begin = TOML.find("draw = [").unwrap();
    let end = TOML[begin..].find("]\n\n").unwrap() + begin + 1;
    let tables = "[[passes.buffer_scene.draw]]\nmesh = \"builtin:knot\"\nvertex = \"hull.vert.glsl\"\n";
    let text = format!("{}{tables}{}", &TOML[..begin], &TOML[end..]);
    write(dir.path(), &[("eddy.toml", &text), ("buffer_scene.glsl", FRAGMENT)]);
    let project = project::load(dir.path().to_str().unwrap()).unwrap().project;
    assert_eq!(project.passes[0].source.name, "buffer_scene.glsl", "by its usual name where no draw names one");
    project::save(&project, dir.path(), Overwrite::Refuse).unwrap();
    assert_eq!(fs::read_to_string(dir.path().join("eddy.toml")).unwrap(), text);
}

#[test]
fn check_tells_of_both_stages_and_the_model_by_file_and_line() {
    let b = Bench::new();
    let folder = b.path("p");
    write(&folder, &[]);
    b.line("check p").expect(0);
    for (file, text, says) in [
        ("scene.vert.glsl", VERTEX.replace("gl_Position", "gl_Positon"), "--> scene.vert.glsl:3:"),
        ("scene.vert.glsl", VERTEX.replace("aPosition", "aPositon"), "a vertex has no attribute `aPositon`"),
        ("scene.vert.glsl", format!("in vec2 aNormal;\n{VERTEX}"), "the attribute `aNormal` is a `vec3`"),
        (
            "scene.frag.glsl",
            FRAGMENT.replace("in vec3 vAt", "flat in vec3 vAt"),
            "`vAt` is not `flat` in the vertex stage",
        ),
        (
            "scene.frag.glsl",
            FRAGMENT.replace("in vec3", "in vec2").replace("vec4(vAt, 1.0)", "vec4(vAt, 1.0, 1.0)"),
            "`vAt` is a `vec2` here and a `vec3` in the vertex",
        ),
        ("scene.frag.glsl", FRAGMENT.replace("vAt", "vAs"), "the vertex stage has no output `vAs`"),
        ("scene.frag.glsl", FRAGMENT.replace("location = 1", "location = 2"), "writes target 2, but the pass has 2"),
        ("scene.frag.glsl", FRAGMENT.replace("location = 1", "location = 0"), "both write target 0"),
        ("scene.frag.glsl", FRAGMENT.replace("layout(location = 1) ", ""), "needs a target number"),
        ("scene.frag.glsl", FRAGMENT.replace("void main()", "void mein()"), "this pass has no `main`"),
        (
            "hull.vert.glsl",
            HULL.replace("gl_Position =", "discard; gl_Position ="),
            "`discard` works only in a fragment stage",
        ),
        ("models/tri.obj", "v 1 2\nf 1".into(), "models/tri.obj is broken"),
    ] {
        write(&folder, &[(file, &text)]);
        let run = b.line("check p").expect(1);
        let all = format!("{}{}", run.out, run.err);
        assert!(all.contains(says), "{file}: {says}\n{all}");
        assert_eq!(all.matches("error: ").count(), 1, "{all}");
    }
    write(&folder, &[]);
    fs::remove_file(folder.join("models/tri.obj")).unwrap();
    let run = b.line("check p").expect(1);
    let all = format!("{}{}", run.out, run.err);
    assert!(all.contains("cannot read p/models/tri.obj"), "{all}");
}

/// What is said of a model that is loaded, but not as its author may think.
#[test]
fn a_model_that_leaves_something_out_is_drawn_with_a_warning() {
    let Some(_) = support::gpu() else { return };
    let b = Bench::new();
    let folder = b.path("p");
    write(&folder, &[]);
    let red = |model: &[u8], warning: Option<&str>| {
        fs::write(folder.join("models/tri.obj"), model).unwrap();
        for command in ["check p --json", "render p --size 8x4 --out p.png --json"] {
            let line = b.line(command).expect(0).json().remove(0);
            let said = line["diagnostics"].as_array().unwrap();
            assert_eq!((&line["status"], said.len()), (&"ok".into(), usize::from(warning.is_some())), "{line}");
            if let Some(words) = warning {
                let message = said[0]["message"].as_str().unwrap();
                assert!(said[0]["severity"] == "warning" && message.contains(words), "{line}");
            }
        }
        b.png("p.png").get_pixel(0, 3).0[0]
    };
    assert_eq!(red(TRIANGLE.as_bytes(), None), 51);
    let marked = format!("\u{feff}{TRIANGLE}");
    assert_eq!(red(marked.as_bytes(), None), 51, "a byte order mark is no part of the text");
    let points = "draw 0 of Buffer scene: models/tri.obj: it has no triangles";
    assert_eq!(red(b"v 0 0 0\np 1\n", Some(points)), 0);
    let broken = format!("{TRIANGLE}v nan 0 0\nf 1 2 4\n");
    assert_eq!(red(broken.as_bytes(), Some("models/tri.obj: line 5: nan is not a number; faces")), 51);
}

#[test]
fn the_sites_json_cannot_hold_a_scene() {
    let b = Bench::new();
    write(&b.path("p"), &[]);
    let run = b.line("export p --out p.json").expect(2);
    let all = format!("{}{}", run.out, run.err);
    assert!(all.contains("p.json cannot store Buffer scene, which draws meshes: Shadertoy has no such pass"), "{all}");
    assert!(!b.path("p.json").exists());
}

#[test]
fn a_saved_stage_or_model_shows_at_once_and_a_broken_one_keeps_the_picture() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    write(&stage.folder(), &[]);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
    assert_eq!(stage.red(), 51);
    stage.settle();

    stage.write("scene.frag.glsl", FRAGMENT.replace("0.2", "0.4"));
    stage.until("the reload", |s| s.text(&Tab::Pass(PassName::buffer("scene"))).contains("0.4"));
    stage.until_compiled();
    assert_eq!(stage.red(), 102);
    let vertex = VERTEX.replace("vec4(aPosition, 1.0)", "vec4(aPosition + 9.0, 1.0)");
    stage.write("scene.vert.glsl", &vertex);
    stage.until("the reload of the stage", |s| s.text(&scene_tab("scene.vert.glsl")) == vertex);
    stage.until_compiled();
    assert_eq!(stage.red(), 0, "moved out of the picture");
    stage.write("scene.vert.glsl", VERTEX);
    stage.until("the stage again", |s| s.text(&scene_tab("scene.vert.glsl")) == VERTEX);
    stage.until_compiled();
    assert_eq!(stage.red(), 102);

    // A broken model: one error, and the picture stays.
    stage.write("models/tri.obj", "v 0 0\n");
    stage.until("the error", |s| s.diagnostics().iter().any(|d| d.message.contains("tri.obj is broken")));
    assert_eq!((stage.session.diagnostics().len(), stage.red()), (1, 102));
    // Elsewhere.
    stage.write("models/tri.obj", TRIANGLE.replace("-1", "7"));
    stage.until("the new model", |s| s.diagnostics().is_empty() && !s.compile_state().compiling);
    stage.tick();
    assert_eq!(stage.red(), 0);

    // Edited here, and saved.
    let tab = scene_tab("hull.vert.glsl");
    stage.session.apply(EditCommand::EditText { tab: tab.clone(), text: format!("// mine\n{HULL}") });
    assert!(stage.session.is_tab_dirty(&tab));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty());
    assert!(stage.read("hull.vert.glsl").starts_with("// mine\n"));
    assert!(stage.notices(Level::Error).is_empty(), "{:?}", stage.session.notices());
}
