//! Hot reload: every way an editor saves comes to one reload, and nothing of either side is lost.

use crate::support::{self, stage::*};
use eddy::{
    project::{Channel, Input, Media, PassName, Sampler, Tab},
    session::{Answer, Command, DiffLine, EditCommand, FileCommand, Level, Question, TransportCommand},
};
use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

fn open(files: &[(&str, &str)]) -> Option<Stage> {
    Some(Stage::open(support::gpu()?, files))
}

#[test]
fn a_save_in_place_or_by_rename_is_one_reload() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    stage.write("image.glsl", plain(0.4));
    stage.until("the reload", |s| s.text(&image_tab()) == plain(0.4));
    stage.until_compiled();
    assert_eq!(stage.red(), 102);
    replace(&stage.path("image.glsl"), &plain(0.6));
    stage.until("the reload after a rename", |s| s.text(&image_tab()) == plain(0.6));
    stage.until_compiled();
    assert_eq!(stage.red(), 153);
    stage.for_a_while();
    assert_eq!(stage.count("reloaded"), 2);
    assert!(!stage.session.is_dirty());
}

#[test]
fn a_burst_of_writes_is_one_reload_and_the_same_content_is_none() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    for i in 0..20 {
        stage.write("image.glsl", plain(i as f32 / 32.0));
        stage.tick();
    }
    stage.until("the reload", |s| s.text(&image_tab()) == plain(19.0 / 32.0));
    stage.for_a_while();
    assert_eq!(stage.count("reloaded"), 1);
    let text = stage.read("image.glsl");
    stage.write("image.glsl", &text);
    replace(&stage.path("image.glsl"), &text);
    stage.for_a_while();
    assert_eq!(stage.count("reloaded"), 1);
}

#[test]
fn a_half_written_file_is_waited_for() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    for half in [&b""[..], b"// \xc3"] {
        stage.write("image.glsl", half);
        let until = std::time::Instant::now() + std::time::Duration::from_millis(200);
        while std::time::Instant::now() < until {
            stage.tick();
        }
        assert_ne!(stage.session.text(&image_tab()), "", "the last whole text stays");
        let text = format!("// é\n{}", plain(if half.is_empty() { 0.4 } else { 0.6 }));
        stage.write("image.glsl", &text);
        stage.until("the whole text", |s| s.text(&image_tab()) == text);
    }
    assert!(stage.notices(Level::Warning).is_empty(), "{:?}", stage.session.notices());

    stage.write("image.glsl", b"\xff\xfe never UTF-8");
    stage.until("a notice", |s| s.notices().iter().any(|n| n.level == Level::Warning));
    stage.for_a_while();
    assert_eq!(stage.notices(Level::Warning).len(), 1, "said once: {:?}", stage.session.notices());
    assert!(stage.notices(Level::Warning)[0].contains("image.glsl is not UTF-8"));
    assert!(stage.session.text(&image_tab()).contains("0.6"));
}

#[test]
fn an_edited_tab_asks_and_keeps_both_texts_whatever_the_answer() {
    for answer in ["mine", "disk", "elsewhere"] {
        let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
        stage.edit(&plain(0.4));
        stage.write("image.glsl", plain(0.6));
        stage.until("the question", |s| s.question().is_some());
        let Some(Question::Conflict { tab, file, mine, disk, diff }) = stage.session.question() else { panic!() };
        assert_eq!((tab.as_ref(), file), (Some(&image_tab()), &stage.path("image.glsl")));
        assert_eq!((&**mine, &**disk), (&*plain(0.4), &*plain(0.6)));
        assert_eq!(diff.iter().filter(|l| !matches!(l, DiffLine::Both(_))).count(), 2);
        assert_eq!(stage.session.text(&image_tab()), plain(0.4), "the edit stays until the answer");
        let elsewhere = stage.path("elsewhere.txt");
        stage.session.apply(FileCommand::Answer(match answer {
            "mine" => Answer::KeepMine,
            "disk" => Answer::TakeDisk,
            _ => Answer::SaveMineAs(elsewhere.clone()),
        }));
        assert!(stage.session.question().is_none(), "{:?}", stage.session.notices());
        match answer {
            "mine" => {
                assert_eq!(stage.session.text(&image_tab()), plain(0.4));
                assert!(stage.session.is_dirty());
                assert_eq!(stage.read("image.glsl.disk-0001"), plain(0.6));
                stage.session.apply(FileCommand::Save);
                assert_eq!(stage.read("image.glsl"), plain(0.4));
            }
            "disk" => {
                assert_eq!(stage.session.text(&image_tab()), plain(0.6));
                assert_eq!(stage.read("image.glsl.mine-0001"), plain(0.4));
            }
            _ => {
                assert_eq!(stage.session.text(&image_tab()), plain(0.6));
                assert_eq!(fs::read_to_string(elsewhere).unwrap(), plain(0.4));
            }
        }
        assert!(!stage.session.is_dirty());
        stage.until_compiled();
        assert_eq!(stage.red(), if answer == "mine" { 102 } else { 153 });
    }
}

/// By a path from the current folder, as it is typed in a terminal.
fn relative(path: &Path) -> PathBuf {
    let here = std::env::current_dir().unwrap();
    let up = here.components().skip(1).map(|_| Path::new(".."));
    up.collect::<PathBuf>().join(path.strip_prefix("/").unwrap())
}

#[test]
fn the_other_text_is_kept_beside_a_file_that_was_opened_by_a_relative_path() {
    for name in ["edit.glsl", "."] {
        let Some(gpu) = support::gpu() else { return };
        let mut stage = Stage::bare(gpu);
        let file = if name == "." { "image.glsl" } else { name };
        stage.write(file, plain(0.2));
        stage.session.apply(FileCommand::Open(relative(&stage.path(name)).display().to_string()));
        assert_eq!(stage.session.text(&image_tab()), plain(0.2), "{:?}", stage.session.notices());
        stage.edit(&plain(0.4));
        stage.write(file, plain(0.6));
        stage.until("the question", |s| s.question().is_some());
        stage.session.apply(FileCommand::Answer(Answer::KeepMine));
        assert_eq!(stage.read(&format!("{file}.disk-0001")), plain(0.6));
        assert_eq!(fs::read_dir(stage.folder()).unwrap().count(), 2);
    }
}

#[test]
fn save_mine_as_never_overwrites() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2)), ("notes.txt", "notes")]) else { return };
    stage.edit(&plain(0.4));
    stage.write("image.glsl", plain(0.6));
    stage.until("the question", |s| s.question().is_some());
    let notes = stage.path("notes.txt");
    stage.session.apply(FileCommand::Answer(Answer::SaveMineAs(notes)));
    assert!(stage.session.question().is_some(), "the question stands on");
    assert_eq!(stage.read("notes.txt"), "notes");
    assert_eq!(stage.session.text(&image_tab()), plain(0.4));
}

#[test]
fn saving_over_a_change_nobody_has_seen_yet_asks_first() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    stage.edit(&plain(0.4));
    stage.write("image.glsl", plain(0.6));
    stage.session.apply(FileCommand::Save);
    assert!(matches!(stage.session.question(), Some(Question::Conflict { .. })));
    assert_eq!(stage.read("image.glsl"), plain(0.6));
}

#[test]
fn a_save_of_our_own_is_no_reload() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    stage.edit(&plain(0.4));
    stage.session.apply(FileCommand::Save);
    assert!(!stage.session.is_dirty());
    assert_eq!(stage.read("image.glsl"), plain(0.4));
    let generation = stage.session.text_generation();
    stage.for_a_while();
    assert_eq!(stage.count("reloaded"), 0);
    assert_eq!(stage.session.text_generation(), generation);
    assert!(stage.session.question().is_none());
}

#[test]
fn a_deleted_file_keeps_its_text_and_saving_writes_it_again() {
    let a = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n";
    let Some(mut stage) = open(&[("buffer_a.glsl", a), ("image.glsl", &plain(0.2))]) else { return };
    let tab = Tab::Pass(PassName::buffer("A"));
    fs::remove_file(stage.path("buffer_a.glsl")).unwrap();
    stage.until("the notice", |s| s.notices().iter().any(|n| n.text.starts_with("buffer_a.glsl was deleted")));
    assert_eq!(stage.session.text(&tab), a);
    assert!(stage.session.is_tab_dirty(&tab));
    stage.write("image.glsl", plain(0.4));
    stage.until("other files still reload", |s| s.text(&image_tab()) == plain(0.4));
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("buffer_a.glsl"), a);
    assert!(!stage.session.is_dirty(), "{:?}", stage.session.notices());

    fs::remove_file(stage.path("image.glsl")).unwrap();
    stage.until("the notice", |s| s.notices().iter().any(|n| n.text.starts_with("image.glsl was deleted")));
    assert!(stage.session.is_tab_dirty(&image_tab()));
    stage.session.apply(FileCommand::Save);
    assert_eq!(stage.read("image.glsl"), plain(0.4));
}

#[test]
fn eddy_toml_reloads_passes_and_channels_and_time_goes_on() {
    let toml = "eddy = 1\nname = \"One\"\n[passes.image]\n";
    let Some(mut stage) = open(&[("eddy.toml", toml), ("image.glsl", &plain(0.2))]) else { return };
    for _ in 0..3 {
        stage.session.apply(TransportCommand::Step);
    }
    stage.tick();
    stage.write("buffer_a.glsl", "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }\n");
    stage.write(
        "eddy.toml",
        "eddy = 1\nname = \"Two\"\n[passes.buffer_a]\n[passes.image]\nchannels.0 = { buffer = \"A\" }\n",
    );
    stage.until("the new pass", |s| s.project().passes.len() == 2);
    assert_eq!(stage.session.project().name, "Two");
    assert!(stage.session.project().image().unwrap().bindings.get(0).is_some());
    stage.until_compiled();
    assert!(stage.session.transport().frame >= 3, "time goes on");

    stage.session.apply(EditCommand::SetResetOnReload(true));
    stage.write("image.glsl", plain(0.4));
    stage.until("the reload", |s| s.text(&image_tab()) == plain(0.4));
    stage.until_compiled();
    assert_eq!(stage.session.transport().frame, 0, "unless the switch says otherwise");

    stage.write("eddy.toml", "eddy = 1\n[passes.image\n");
    stage.until("a notice", |s| s.notices().iter().any(|n| n.level == Level::Warning));
    assert!(stage.notices(Level::Warning)[0].contains("eddy.toml"), "{:?}", stage.notices(Level::Warning));
    assert_eq!(stage.session.project().passes.len(), 2, "the last whole one stays");
}

#[test]
fn channels_changed_here_and_on_disk_ask() {
    let toml = "eddy = 1\n[passes.image]\n";
    let Some(mut stage) = open(&[("eddy.toml", toml), ("image.glsl", &plain(0.2))]) else { return };
    let channel = eddy::project::Channel::new(eddy::project::Input::KEYBOARD);
    stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 0, channel: Some(channel) });
    stage.write("eddy.toml", "eddy = 1\n[passes.image]\nchannels.1 = { texture = \"noise-rgba-64\" }\n");
    stage.until("the question", |s| s.question().is_some());
    let Some(Question::Conflict { tab: None, mine, disk, .. }) = stage.session.question() else { panic!() };
    assert!(mine.contains("keyboard") && disk.contains("noise-rgba-64"), "{mine}\n--\n{disk}");
    stage.session.apply(FileCommand::Answer(Answer::TakeDisk));
    let channels = &stage.session.project().image().unwrap().bindings;
    assert!(channels.get(0).is_none() && channels.get(1).is_some());
    assert!(stage.read("eddy.toml.mine-0001").contains("keyboard"));
    assert!(!stage.session.is_dirty());
}

fn picture(red: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    image::RgbaImage::from_pixel(u32::from(red / 50).max(1), 1, image::Rgba([red, 0, 0, 255]))
        .write_to(&mut std::io::Cursor::new(&mut bytes), image::ImageFormat::Png)
        .unwrap();
    bytes
}

#[test]
fn a_picture_changed_on_disk_is_read_again() {
    let shader = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }\n";
    let toml = "eddy = 1\n[passes.image]\nchannels.0 = { file = \"pic.png\", filter = \"nearest\" }\n";
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("pic.png", picture(50));
    stage.write("image.glsl", shader);
    stage.write("eddy.toml", toml);
    stage.session.apply(FileCommand::Open(stage.folder().to_str().unwrap().into()));
    stage.compile(Command::Transport(TransportCommand::Pause));
    assert_eq!(stage.red(), 50);
    let mut file = fs::File::create(stage.path("pic.png")).unwrap();
    file.write_all(&picture(200)).unwrap();
    drop(file);
    stage.until_red(200);
    // Before its first compile has read anything.
    stage.session.apply(FileCommand::Open(stage.folder().to_str().unwrap().into()));
    stage.write("pic.png", picture(100));
    stage.until_compiled();
    stage.until_red(100);
}

#[test]
fn writes_without_an_end_beside_the_sources_do_not_hide_a_change() {
    let Some(mut stage) = open(&[("image.glsl", &plain(0.2))]) else { return };
    stage.write("image.glsl", plain(0.4));
    let end = Instant::now() + Duration::from_secs(30);
    let mut line = 0;
    while stage.session.text(&image_tab()) != plain(0.4) {
        assert!(Instant::now() < end, "the log put the reload off for ever");
        line += 1;
        stage.write("run.log", format!("{line}\n"));
        stage.tick();
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
fn a_picture_chosen_here_is_watched_wherever_it_lies() {
    let shader = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(0), 0); }\n";
    let Some(mut stage) = open(&[("eddy.toml", "eddy = 1\n[passes.image]\n"), ("image.glsl", shader)]) else { return };
    let elsewhere = tempfile::tempdir().unwrap();
    let path = elsewhere.path().join("pic.png");
    fs::write(&path, picture(50)).unwrap();
    let input = Input::texture(Media::Picked(path.clone()));
    let channel = Channel { input, sampler: Sampler { filter: eddy::project::Filter::Nearest, ..Sampler::TEXTURE } };
    stage.session.apply(EditCommand::SetChannel { pass: PassName::image(), index: 0, channel: Some(channel) });
    stage.until_red(50);
    fs::write(&path, picture(200)).unwrap();
    stage.until_red(200);
}

#[test]
fn a_picture_read_by_a_compile_that_was_overtaken_is_not_forgotten() {
    let shader = |n: u32| {
        format!("// {n}\nvoid mainImage(out vec4 o, in vec2 p) {{ o = texelFetch(iChannel0, ivec2(0), 0); }}\n")
    };
    let toml = "eddy = 1\n[passes.image]\nchannels.0 = { file = \"pic.png\", filter = \"nearest\" }\n";
    let Some(gpu) = support::gpu() else { return };
    let mut stage = Stage::bare(gpu);
    stage.write("pic.png", picture(50));
    stage.write("image.glsl", shader(0));
    stage.write("eddy.toml", toml);
    stage.compile(Command::File(FileCommand::Open(stage.folder().to_str().unwrap().into())));
    for n in 1..12 {
        let red = if n % 2 == 0 { 50 } else { 200 };
        stage.write("pic.png", picture(red));
        // Compiles one after the other, most begun before the last has ended, while the new picture is found.
        let end = Instant::now() + Duration::from_millis(300);
        let mut edits = 0;
        while Instant::now() < end {
            edits += 1;
            stage.edit(&shader(n * 100_000 + edits));
            stage.act(Command::Edit(EditCommand::CompileNow));
        }
        stage.until_red(red);
    }
}
