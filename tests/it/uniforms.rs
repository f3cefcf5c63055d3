//! Custom uniforms, from an `#iUniform` line to the picture.

use crate::support::{stage::*, walked::assert_walked, *};
use eddy::{
    diag::render_all,
    engine::{BuildError, BuildOptions, Program},
    media::MediaSet,
    project::{CustomUniformType, CustomUniformValue, PassName, Source},
    session::{Command, EditCommand, FileCommand, Level},
};

const ALL: &str = "
vec4 above() { return vec4(speed, float(count), vec2(at)); }
#iUniform float speed = 0.25
#iUniform int count = -3
#iUniform vec2 at = vec2(0.5, 2.5)
#iUniform color3 tint = color3(1.0, 0.5, 0.125)
#iUniform vec4 gain = vec4(1.0, 2.0, 3.0, 4.0)
#iUniform bool on = true
void mainImage(out vec4 o, in vec2 p) {
    int x = int(p.x);
    if (x == 0) o = above();
    else if (x == 1) o = vec4(tint, on ? 1.0 : 0.0);
    else if (x == 2) o = gain;
    else { int i = x - 3; vec4 g = gain; o = vec4(gain[i], tint.zx, g.wzyx[i]); }
}";

fn row(pixels: &eddy::engine::Pixels) -> Vec<[f32; 4]> {
    pixels.texels[..4].to_vec()
}

#[test]
fn every_type_reaches_the_shader_and_changes_compile_nothing() {
    let Some(gpu) = gpu() else { return };
    let a = pass(buffer("A"), ALL, Default::default());
    let mut project =
        project(vec![a, image("void mainImage(out vec4 o, in vec2 p) { o = vec4(0.0); }", Default::default())]);
    let options = BuildOptions { requested: vec![buffer("A")], skip: true, ..BuildOptions::default() };
    let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &options, (4, 1));
    run(&mut engine, 0, 1);
    assert_walked(&mut engine, &project, &buffer("A"));
    assert_eq!(
        row(&engine.read(&buffer("A")).unwrap()),
        [[0.25, -3.0, 0.5, 2.5], [1.0, 0.5, 0.125, 1.0], [1.0, 2.0, 3.0, 4.0], [1.0, 0.125, 1.0, 4.0]]
    );
    for set in ["speed=-1e-3", "count=2147483647", "at=7", "on=false", "gain=9,8,7,6", "tint=0,0,1"] {
        let set = if set == "at=7" { "at=vec2(7)" } else { set };
        project.set_custom_uniform(set).unwrap();
    }
    assert!(engine.set_custom_uniforms(&project.custom_uniform_values));
    assert!(!engine.set_custom_uniforms(&project.custom_uniform_values), "equal values were reported as a change");
    run(&mut engine, 1, 2);
    assert_walked(&mut engine, &project, &buffer("A"));
    let changed = row(&engine.read(&buffer("A")).unwrap());
    assert_eq!(
        changed,
        [[-1e-3, 2147483648.0, 7.0, 7.0], [0.0, 0.0, 1.0, 0.0], [9.0, 8.0, 7.0, 6.0], [9.0, 1.0, 0.0, 6.0]]
    );
    // A program built from the project's current values starts with them.
    let mut fresh = engine_with(&gpu, &project, &MediaSet::new(), &options, (4, 1));
    run(&mut fresh, 0, 1);
    assert_eq!(row(&fresh.read(&buffer("A")).unwrap()), changed);
}

#[test]
fn uniforms_of_common_are_global_and_those_of_a_pass_are_local() {
    let Some(gpu) = gpu() else { return };
    let write =
        "#iUniform float own = 2.0\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(own, shared_one, 0.0, 1.0); }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + shared_one; }";
    let mut p =
        project(vec![pass(buffer("A"), write, Default::default()), image(show, [nearest("A"), None, None, None])]);
    p.common = Some(Source { name: "Common".into(), path: None, text: "#iUniform float shared_one = 0.5".into() });
    let mut engine = ran(&gpu, &p, (1, 1), 1);
    assert_walked(&mut engine, &p, &buffer("A"));
    assert_walked(&mut engine, &p, &PassName::image());
    assert_eq!(texel(&engine.read_image().unwrap(), 0, 0), [2.5, 1.0, 0.5, 1.0]);
    let mut other = p.clone();
    other.passes[1].source.text = show.replace("shared_one", "own").into();
    let message = errors(&gpu, &other);
    assert!(message.contains("`own` is not declared"), "{message}");
}

fn errors(gpu: &eddy::gpu::Gpu, project: &eddy::project::Project) -> String {
    match Program::build(gpu, project, &MediaSet::new(), &BuildOptions::default()) {
        Err(BuildError::Diagnostics { diagnostics, sources }) => render_all(&diagnostics, &sources),
        Err(e) => panic!("{e}"),
        Ok(_) => panic!("it compiles"),
    }
}

#[test]
fn declaration_errors_are_reported_at_their_line() {
    let Some(gpu) = gpu() else { return };
    let main = "\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }";
    for (line, message) in [
        ("#iUniform float iTime", "a uniform cannot be named `iTime`: Shadertoy's header has a uniform of this name"),
        ("#iUniform float mainImage", "a uniform cannot be named `mainImage`: it is the name of an entry point"),
        ("#iUniform float smoothstep", "GLSL has a function of this name"),
        ("#iUniform float input", "it is a GLSL keyword"),
        ("#iUniform float a = 1.0 on", "expected `in`, `step` or the end of the line"),
        ("#iUniform float a\nfloat a;", "`a` is already declared by an #iUniform line"),
        ("#iUniform float a\nvoid f() { a = 1.0; }", "`a` is a uniform and cannot be"),
    ] {
        let found = errors(&gpu, &project(vec![image(&format!("{line}{main}"), Default::default())]));
        assert!(found.contains(message) && found.contains("--> Image:"), "{line}\n{found}");
    }
    let hidden = "#iUniform float a\nfloat f(float a) { a += 1.0; return a; }";
    engine(&gpu, &project(vec![image(&format!("{hidden}{main}"), Default::default())]), (1, 1));
}

const SLIDER: &str = "#iUniform float red = 0.2 in { 0.0, 1.0 }
#iUniform int n = 1 in { 0, 3 }
void mainImage(out vec4 o, in vec2 p) { o = vec4(red * float(n), 0.0, 0.0, 1.0); }
";

fn set(name: &str, value: CustomUniformValue) -> Command {
    Command::Edit(EditCommand::SetCustomUniform { name: name.into(), value: Some(value) })
}

#[test]
fn a_slider_moved_while_paused_draws_one_frame_and_is_saved() {
    let Some(gpu) = gpu() else { return };
    let toml = "# mine\neddy = 1\n\n[uniforms] # turned\nred = 0.4 # warm\n\n[passes.image]\n";
    let mut stage = Stage::open(gpu, &[("image.glsl", SLIDER), ("eddy.toml", toml)]);
    assert_eq!(stage.red(), 102);
    let (frames, compiles) = (stage.frames(), stage.session.compile_state().clone());
    stage.act(set("red", CustomUniformValue::Float(0.6)));
    stage.tick();
    assert_eq!((stage.red(), stage.frames()), (153, frames + 1));
    assert_eq!(stage.session.compile_state(), &compiles, "nothing was compiled");
    assert!(stage.session.is_dirty());
    stage.session.apply(set("red", CustomUniformValue::Float(7.0)));
    stage.session.apply(set("n", CustomUniformValue::Int(0)));
    stage.act(set("nobody", CustomUniformValue::Int(0)));
    assert_eq!(stage.red(), 0);
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty());
    assert_eq!(
        stage.read("eddy.toml"),
        "# mine\neddy = 1\n\n[uniforms] # turned\nred = 1.0 # warm\nn = 0\n\n[passes.image]\n"
    );
    stage.act(Command::Edit(EditCommand::SetCustomUniform { name: "n".into(), value: None }));
    assert_eq!(stage.red(), 255);
    stage.act(Command::Edit(EditCommand::ResetCustomUniforms));
    assert_eq!(stage.red(), 51);
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("eddy.toml"), "# mine\neddy = 1\n\n[passes.image]\n");
    stage.session.apply(EditCommand::AssignCustomUniform("red=0.5".into()));
    stage.act(Command::Edit(EditCommand::AssignCustomUniform("rde=0.5".into())));
    assert_eq!(stage.red(), 128);
    assert_eq!(stage.notices(Level::Error), ["not set: no #iUniform line declares `rde` (did you mean red?)"]);
}

#[test]
fn uniform_changes_can_be_undone_and_are_listed_as_unsaved() {
    let Some(gpu) = gpu() else { return };
    let toml = "eddy = 1\n\n[passes.image]\n";
    let mut stage = Stage::open(gpu, &[("image.glsl", SLIDER), ("eddy.toml", toml)]);
    assert_eq!(stage.session.unsaved_parts(), [""; 0]);
    // A drag has many values and is one undo step; another uniform is another step.
    for red in [0.3, 0.5, 0.8] {
        stage.session.apply(set("red", CustomUniformValue::Float(red)));
    }
    stage.session.apply(set("n", CustomUniformValue::Int(0)));
    assert_eq!(stage.session.unsaved_parts(), ["uniform n and red"]);
    let title = |stage: &Stage| stage.session.pass_undo().map(|step| step.title.to_owned());
    assert_eq!(title(&stage).as_deref(), Some("change n"));
    stage.act(Command::Edit(EditCommand::UndoPassEdit));
    assert_eq!((stage.red(), title(&stage).as_deref()), (204, Some("change red")));
    stage.act(Command::Edit(EditCommand::UndoPassEdit));
    assert_eq!(
        (stage.red(), stage.session.is_dirty(), title(&stage)),
        (51, false, None),
        "the whole drag is one undo step"
    );
    stage.act(Command::Edit(EditCommand::RedoPassEdit));
    assert_eq!(stage.red(), 204);
    stage.session.apply(EditCommand::ResetCustomUniforms);
    stage.act(Command::Edit(EditCommand::UndoPassEdit));
    assert_eq!(stage.red(), 204, "resetting all values is an undo step");
    // Pass edits are in the same undo history, and each step restores its own change.
    stage.session.apply(EditCommand::AddTab(eddy::project::Tab::Common));
    assert_eq!(stage.session.unsaved_parts(), ["Common", "the list of passes", "uniform red"]);
    stage.act(Command::Edit(EditCommand::UndoPassEdit));
    assert_eq!((stage.red(), stage.session.unsaved_parts()), (204, vec!["uniform red".to_owned()]));
}

#[test]
fn custom_uniforms_follow_edits_and_reloads() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", SLIDER)]);
    stage.session.apply(set("red", CustomUniformValue::Float(0.8)));
    stage.edit(&SLIDER.replace("1.0 }", "0.5 }"));
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert_eq!(stage.session.custom_uniforms()[0].ty, CustomUniformType::Float);
    assert_eq!(stage.red(), 128, "within the new range");
    stage.edit(SLIDER);
    stage.compile(Command::Edit(EditCommand::CompileNow));
    assert_eq!(stage.red(), 204, "in the old range again");
    stage.session.apply(FileCommand::Save);
    assert!(stage.read("eddy.toml").contains("[uniforms]\nred = 0.8\n"), "{}", stage.read("eddy.toml"));
    stage.write("eddy.toml", stage.read("eddy.toml").replace("0.8", "0.4"));
    stage.until("the value from disk", |s| {
        s.custom_uniform_value(&s.custom_uniforms()[0]) == CustomUniformValue::Float(0.4)
    });
    stage.until_compiled();
    assert_eq!(stage.red(), 102);
}

#[test]
fn editor_services_know_custom_uniforms_and_included_files() {
    let code = "#include \"lib.glsl\"\n#iUniform color3 tint\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(tint, \
                half_of(1.0)); }";
    let mut project = project(vec![image(code, Default::default())]);
    let lib = "float half_of(float x) { return 0.5 * x * level; }\n#iUniform float level\n";
    let source = Source { name: "lib.glsl".into(), path: None, text: lib.into() };
    project.includes = vec![eddy::project::Included { source, trouble: None, is_limit: false, is_edited: false }];
    let texts = eddy::engine::Sources::new(&project);
    assert_eq!(texts.diagnostics, []);
    let analysis = texts.analyse(0);
    let here = eddy::diag::SourceId(1);
    let at = |word: &str| code.rfind(word).unwrap();
    assert_eq!(analysis.hover(here, at("tint")).unwrap().signature, ["uniform vec3 tint"]);
    let definition = analysis.definition(here, at("half_of")).unwrap();
    assert_eq!((definition.source.0, &lib[definition.range()]), (2, "half_of"));
    assert!(texts.compile_pass(0, eddy::glsl::Driver::default()).is_ok());
}
