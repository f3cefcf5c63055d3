//! `#include` lines from the file to the picture, and back to the file when something is wrong in it.

use crate::support::{gpu, program::Bench, stage::*};
use eddy::{
    project::{PassName, Tab},
    session::{Answer, Command, EditCommand, FileCommand, Question, TransportCommand},
};

const USES: &str =
    "#include \"lib/tone.glsl\"\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(tone(), 0.0, 0.0, 1.0); }\n";

#[test]
fn an_error_in_an_included_file_is_shown_there() {
    let b = Bench::new();
    b.write("p/image.glsl", USES);
    b.write("p/buffer_a.glsl", USES);
    b.write("p/lib/tone.glsl", "// ok\nfloat tone() { return half_of(1.0); }\n");
    let run = b.line("check p").expect(1);
    assert!(run.err.contains("lib/tone.glsl:2:"), "{}", run.err);
    assert_eq!(run.err.matches("there is no function `half_of`").count(), 1, "{}", run.err);
    b.write("p/lib/tone.glsl", "#if 1\nfloat tone() { return 1.0; }\n");
    assert!(b.line("check p").expect(1).err.contains("lib/tone.glsl:1:"));
    b.write("p/lib/tone.glsl", "/* open\nfloat tone() { return 1.0; }\n");
    assert!(b.line("check p").expect(1).err.contains("lib/tone.glsl:1:1"));
    b.write(
        "p/lib/tone.glsl",
        "#ifndef TONE\n#define TONE\n#iUniform float level = 0.5 in { 0.0, 1.0 }\nfloat tone() \
                                { return level; }\n#endif\n",
    );
    b.write("p/common.glsl", "#include \"lib/tone.glsl\"\n");
    b.line("check p").expect(0);
    b.line("export p --out p.json --force").expect(0);
    b.line("check p.json").expect(0);
}

#[test]
fn a_file_that_no_compiled_group_includes_may_be_missing() {
    let b = Bench::new();
    let image = "void mainImage(out vec4 o, in vec2 p) { o = vec4(K); }\n";
    for group in ["#ifdef NOISE\n@#endif\n", "#if 0\n@#endif\n", "#if 1\n#else\n#if 1\n@#endif\n#endif\n"] {
        let group = group.replace('@', "#include \"lib/none.glsl\"\n#include \"../out.glsl\"\n");
        b.write("p/common.glsl", "const float K = 1.0;\n");
        b.write("p/image.glsl", format!("{group}{image}"));
        let run = b.line("check p").expect(0);
        assert!(!run.err.contains("none.glsl"), "{}", run.err);
        b.line("export p --out p.json --force").expect(0);
    }
    // A macro of Common decides, and the words are those of a line outside of any group.
    let guarded = format!("#ifdef NOISE\n#include \"lib/none.glsl\"\n#endif\n{image}");
    b.write("p/image.glsl", guarded.as_str());
    b.line("check p").expect(0);
    b.write("p/common.glsl", "#define NOISE\nconst float K = 1.0;\n");
    let run = b.line("check p").expect(1);
    let words = "#include \"lib/none.glsl\": there is no file lib/none.glsl";
    assert!(run.err.contains(words) && run.err.contains("image.glsl:2:1"), "{}", run.err);
    assert_eq!(run.err.matches(words).count(), 1, "{}", run.err);
    assert!(b.line("export p --out q.json").expect(1).err.contains(words));
    assert!(b.line("translate p --to wgsl --out w").expect(1).err.contains(words));
    // In Common itself, which every pass has in front, and in a file that is included.
    b.write("p/image.glsl", format!("#include \"tone.glsl\"\n{image}"));
    b.write("p/buffer_a.glsl", image);
    b.write("p/tone.glsl", "#if 1\n#include \"later.glsl\"\n#else\n#include \"never.glsl\"\n#endif\n");
    b.write("p/common.glsl", "#include \"first.glsl\"\nconst float K = 1.0;\n#if 0\n#include \"never.glsl\"\n#endif\n");
    let run = b.line("check p").expect(1);
    for (place, file) in [("common.glsl:1:1", "first.glsl"), ("tone.glsl:2:1", "later.glsl")] {
        let words = format!("there is no file {file}");
        assert!(run.err.contains(place) && run.err.matches(&words).count() == 1, "{}", run.err);
    }
    assert!(!run.err.contains("never.glsl"), "{}", run.err);
}

#[test]
fn line_numbers_count_through_included_lines_as_in_the_export() {
    let Some(b) = Bench::with_gpu() else { return };
    let main = "void mainImage(out vec4 o, in vec2 p) { o = vec4(float(FIRST), float(__LINE__), 0.0, 1.0); }\n";
    b.write("p/image.glsl", format!("int x;\n#include \"two.glsl\"\n#include \"two.glsl\"\n{main}"));
    b.write("p/two.glsl", "\n#ifndef FIRST\n#define FIRST __LINE__\n#endif\n");
    b.line("export p --out p.json").expect(0);
    for p in ["p", "p.json"] {
        b.line(&format!("render {p} --size 1x1 --out {}.npy", p.replace('.', "_"))).expect(0);
    }
    let (own, site) = (b.npy("p.npy").at(0, 0), b.npy("p_json.npy").at(0, 0));
    assert_eq!(own, site);
    assert!(own[1] > 10.0);
}

#[test]
fn an_included_file_is_watched_and_its_errors_name_it() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::bare(gpu);
    std::fs::create_dir(stage.path("lib")).unwrap();
    stage.write("image.glsl", USES);
    stage.write("lib/tone.glsl", "float tone() { return 1.0; }");
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    assert_eq!(stage.red(), 255);
    replace(&stage.path("lib/tone.glsl"), "float tone() { return 0.2; }");
    stage.until_red(51);
    assert!(!stage.session.is_dirty());
    stage.write("lib/tone.glsl", "float tone() { return none; }");
    stage.until("the error", |s| {
        let places = s.diagnostics().iter().filter_map(|d| d.place.as_ref());
        places.into_iter().any(|p| p.tab.as_ref() == Some(&tone()) && p.text == "lib/tone.glsl" && p.line == 1)
    });
    // A line typed now, of a file that comes later.
    stage.edit(&USES.replace("tone.glsl", "late.glsl"));
    stage.session.apply(EditCommand::CompileNow);
    stage.until("the missing file", |s| {
        s.diagnostics().iter().any(|d| d.message.contains("there is no file lib/late.glsl"))
    });
    stage.settle();
    stage.write("lib/late.glsl", "float tone() { return 0.6; }");
    stage.until("a good compile", |s| s.diagnostics().is_empty());
    stage.until_compiled();
    assert_eq!(stage.red(), 153);
}

fn tone() -> Tab {
    Tab::Included("lib/tone.glsl".into())
}

fn type_into(stage: &mut Stage, text: &str) {
    stage.session.apply(EditCommand::EditText { tab: tone(), text: text.into() });
}

fn with_tone(text: &str) -> Option<Stage> {
    let mut stage = Stage::bare(gpu()?);
    std::fs::create_dir(stage.path("lib")).unwrap();
    stage.write("image.glsl", USES);
    stage.write("buffer_a.glsl", USES);
    stage.write("lib/tone.glsl", text);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    stage.settle();
    Some(stage)
}

#[test]
fn an_included_file_is_edited_compiled_and_saved_like_a_pass() {
    let Some(mut stage) = with_tone("float tone() { return 1.0; }") else { return };
    assert!(stage.session.tabs().contains(&tone()));
    let users = stage.session.project().tabs_that_include(&tone());
    assert_eq!(users, [Tab::Pass(PassName::buffer("A")), image_tab()]);
    let at = USES.find("lib").unwrap();
    assert_eq!(stage.session.project().included_at(&image_tab(), at), Some(tone()));
    assert_eq!(stage.session.project().included_at(&image_tab(), USES.len() - 3), None);

    type_into(&mut stage, "float tone() { return 0.2; }");
    assert!(
        stage.session.is_dirty() && stage.session.is_tab_dirty(&tone()) && !stage.session.is_tab_dirty(&image_tab())
    );
    stage.until_red(51);
    assert_eq!(stage.read("lib/tone.glsl"), "float tone() { return 1.0; }", "nothing is written unasked");
    // An edit that has the files read anew leaves what was typed.
    stage.edit(&format!("#include \"lib/late.glsl\"\n{USES}"));
    stage.session.apply(EditCommand::CompileNow);
    stage.until("the missing file", |s| s.diagnostics().iter().any(|d| d.message.contains("late.glsl")));
    stage.edit(USES);
    stage.session.apply(EditCommand::CompileNow);
    stage.until("a good compile", |s| s.diagnostics().is_empty());
    assert_eq!(stage.session.text(&tone()), "float tone() { return 0.2; }");
    // So does a text that includes it no more.
    stage.edit(&plain(0.0));
    stage.session.apply(EditCommand::EditText { tab: Tab::Pass(PassName::buffer("A")), text: plain(0.0) });
    stage.session.apply(EditCommand::CompileNow);
    stage.until_red(0);
    assert!(stage.session.is_tab_dirty(&tone()));
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("lib/tone.glsl"), "float tone() { return 0.2; }");
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
    // And back to what is on disk is no edit.
    stage.edit(USES);
    stage.session.apply(EditCommand::CompileNow);
    stage.until_red(51);
    type_into(&mut stage, "float tone() { return 0.6; }");
    assert!(stage.session.is_tab_dirty(&tone()));
    type_into(&mut stage, "float tone() { return 0.2; }");
    assert!(!stage.session.is_tab_dirty(&tone()));
}

#[test]
fn a_change_on_disk_of_an_edited_included_file_is_a_conflict() {
    let Some(mut stage) = with_tone("float tone() { return 1.0; }") else { return };
    // Not edited: it follows.
    let generation = stage.session.text_generation();
    stage.write("lib/tone.glsl", "float tone() { return 0.2; }");
    stage.until_red(51);
    assert!(stage.session.text_generation() > generation && !stage.session.is_dirty());
    type_into(&mut stage, "float tone() { return 0.6; }");
    stage.write("lib/tone.glsl", "float tone() { return 0.4; }");
    stage.until("a question", |s| s.question().is_some());
    let Some(Question::Conflict { tab, file, mine, disk, .. }) = stage.session.question().cloned() else { panic!() };
    assert_eq!((tab, file), (Some(tone()), stage.path("lib/tone.glsl")));
    assert_eq!((&*mine, &*disk), ("float tone() { return 0.6; }", "float tone() { return 0.4; }"));
    stage.session.apply(FileCommand::Answer(Answer::TakeDisk));
    assert_eq!(stage.session.text(&tone()), "float tone() { return 0.4; }");
    assert!(!stage.session.is_dirty());
    stage.until_red(102);
    // And the same where only an edited text includes it, with the answer of the other side.
    stage.write("lib/late.glsl", "float late() { return 0.0; }");
    stage.edit(&format!("#include \"lib/late.glsl\"\n{USES}"));
    stage.session.apply(EditCommand::CompileNow);
    let late = || Tab::Included("lib/late.glsl".into());
    stage.until("the file", |s| s.tabs().contains(&late()) && !s.compile_state().compiling);
    stage.session.apply(EditCommand::EditText { tab: late(), text: "float late() { return 1.0; }".into() });
    stage.write("lib/late.glsl", "float late() { return 2.0; }");
    stage.until("a question", |s| s.question().is_some());
    stage.session.apply(FileCommand::Answer(Answer::KeepMine));
    assert_eq!(stage.session.text(&late()), "float late() { return 1.0; }");
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("lib/late.glsl"), "float late() { return 1.0; }");
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
}

#[test]
fn an_edited_included_file_goes_into_the_snapshot_and_into_another_folder() {
    let Some(mut stage) = with_tone("float tone() { return 1.0; }") else { return };
    type_into(&mut stage, "float tone() { return 0.2; }");
    let text = eddy::project::write_snapshot(stage.session.project()).unwrap();
    let mut read = eddy::project::read_snapshot(&text).unwrap();
    read.read_includes();
    assert_eq!(read.source(&tone()).map(|s| &*s.text), Some("float tone() { return 0.2; }"));
    // A name that leads out of the folder is nobody's file.
    let hostile = text.replace("\"lib/tone.glsl\"", "\"../tone.glsl\"");
    assert!(hostile != text && eddy::project::read_snapshot(&hostile).unwrap().includes.is_empty());
    let copy = stage.dir.path().join("copy");
    stage.session.apply(FileCommand::SaveAs(copy.clone()));
    assert_eq!(std::fs::read_to_string(copy.join("lib/tone.glsl")).unwrap(), "float tone() { return 0.2; }");
    assert_eq!(stage.read("lib/tone.glsl"), "float tone() { return 1.0; }");
    assert!(!stage.session.is_dirty());
}

#[test]
fn a_file_that_lone_glsl_includes_is_saved_beside_it() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::bare(gpu);
    std::fs::create_dir(stage.path("lib")).unwrap();
    stage.write("lone.glsl", USES);
    stage.write("lib/tone.glsl", "float tone() { return 1.0; }");
    let file = stage.path("lone.glsl");
    stage.session.apply(FileCommand::Open(file.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    type_into(&mut stage, "float tone() { return 0.2; }");
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("lib/tone.glsl"), "float tone() { return 0.2; }");
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());
}

#[test]
fn a_keystroke_reads_no_file_and_a_new_include_is_read_by_the_compile() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.0))]);
    std::fs::create_dir(stage.path("lib")).unwrap();
    stage.write("lib/tone.glsl", "float tone() { return 1.0; }");
    stage.write("lib/late.glsl", "float tone() { return 0.6; }");
    stage.write("image.glsl", USES);
    let folder = stage.folder();
    stage.session.apply(FileCommand::Open(folder.to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    assert_eq!(stage.red(), 255);
    stage.settle();
    let read = |stage: &Stage| -> Vec<(String, String)> {
        let includes = &stage.session.project().includes;
        includes.iter().map(|i| (i.source.name.clone(), i.source.text.to_string())).collect()
    };
    let before = read(&stage);
    stage.write("lib/tone.glsl", "float tone() { return 0.2; }");
    stage.edit(&format!("{USES} // typed"));
    stage.edit(&USES.replace("tone.glsl", "late.glsl"));
    assert_eq!(read(&stage), before, "nothing is read where the keys come in");
    stage.session.apply(EditCommand::CompileNow);
    stage.until("the new file", |s| s.project().includes[0].source.name == "lib/late.glsl");
    stage.until_red(153);
    // Back, within a text that is compiled anew: the file that has changed meanwhile is read.
    stage.edit(USES);
    stage.session.apply(EditCommand::CompileNow);
    stage.until_red(51);
}

#[test]
fn a_file_that_is_included_just_before_a_save_is_saved_too() {
    let Some(gpu) = gpu() else { return };
    let mut stage = Stage::open(gpu, &[("image.glsl", &plain(0.0))]);
    std::fs::create_dir(stage.path("lib")).unwrap();
    stage.write("lib/tone.glsl", "float tone() { return 1.0; }");
    stage.edit(USES);
    let copy = stage.path("copy");
    stage.session.apply(FileCommand::SaveAs(copy.clone()));
    assert!(copy.join("lib/tone.glsl").is_file(), "{:?}", stage.session.notices());
}
