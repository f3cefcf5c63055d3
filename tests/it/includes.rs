//! `#include` lines from the file to the picture, and back to the file when something is wrong in it.

use crate::support::{gpu, program::Bench, stage::*};

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
fn line_numbers_count_through_included_lines_as_in_the_export() {
    let Some(_) = gpu() else { return };
    let b = Bench::new();
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
    stage.session.apply(eddy::session::Command::Open(folder.to_str().unwrap().into()));
    stage.session.apply(eddy::session::Command::Pause);
    stage.until_compiled();
    assert_eq!(stage.red(), 255);
    replace(&stage.path("lib/tone.glsl"), "float tone() { return 0.2; }");
    stage.until_red(51);
    assert!(!stage.session.is_dirty());
    stage.write("lib/tone.glsl", "float tone() { return none; }");
    stage.until("the error", |s| {
        let places = s.diagnostics().iter().filter_map(|d| d.place.as_ref());
        places.into_iter().any(|p| p.tab.is_none() && p.text == "lib/tone.glsl" && p.line == 1)
    });
    // A line typed now, of a file that comes later.
    stage.edit(&USES.replace("tone.glsl", "late.glsl"));
    stage.session.apply(eddy::session::Command::CompileNow);
    stage.until("the missing file", |s| {
        s.diagnostics().iter().any(|d| d.message.contains("there is no file lib/late.glsl"))
    });
    stage.settle();
    stage.write("lib/late.glsl", "float tone() { return 0.6; }");
    stage.until("a good compile", |s| s.diagnostics().is_empty());
    stage.until_compiled();
    assert_eq!(stage.red(), 153);
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
    stage.session.apply(eddy::session::Command::Open(folder.to_str().unwrap().into()));
    stage.session.apply(eddy::session::Command::Pause);
    stage.until_compiled();
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
    stage.session.apply(eddy::session::Command::CompileNow);
    stage.until("the new file", |s| s.project().includes[0].source.name == "lib/late.glsl");
    stage.until_red(153);
    // Back, within a text that is compiled anew: the file that has changed meanwhile is read.
    stage.edit(USES);
    stage.session.apply(eddy::session::Command::CompileNow);
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
    stage.session.apply(eddy::session::Command::SaveAs(copy.clone()));
    assert!(copy.join("lib/tone.glsl").is_file(), "{:?}", stage.session.notices());
}
