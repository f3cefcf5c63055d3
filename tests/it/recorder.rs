//! Films that a session makes: a range has the bytes that `eddy render` writes, what is recorded live has every frame, and
//! nothing is left of what is cancelled.

use crate::support::{
    self,
    ffmpeg::{decoded, decoded_sound, has_ffmpeg, probed},
    program::run,
    stage::*,
};
use eddy::{
    film::Format,
    gpu::Gpu,
    session::{
        Answer, CanvasCommand, Command, EditCommand, FileCommand, FilmCommand, FilmField, FilmForm, FilmOrder,
        FilmView, InputCommand, Level, Question, Request, Session, TransportCommand,
    },
};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::Command as Process,
    time::{Duration, Instant},
};

/// Sums what it saw of time and mouse.
const SUM: &str = "#iUniform float level = 0.5 in { 0.0, 1.0 }
void mainImage(out vec4 o, in vec2 p) {
    o = fract(texelFetch(iChannel0, ivec2(p), 0) + vec4(iTimeDelta, abs(iMouse.x) * 0.01, level * 0.01, 1.0));
}
";
const SHOW: &str =
    "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + p.xyxy * 0.01; }\n";
const SOUND: &str = "vec2 mainSound(int samp, float time) { return vec2(sin(time * 2764.6)); }\n";
const MANIFEST: &str = "eddy = 1\n[passes.buffer_a]\nchannels.0 = { buffer = \"A\" }\n[passes.image]\nchannels.0 = { buffer = \
                        \"A\" }\n[passes.sound]\n";

fn stage(gpu: Gpu) -> Stage {
    let files = [("eddy.toml", MANIFEST), ("buffer_a.glsl", SUM), ("image.glsl", SHOW), ("sound.glsl", SOUND)];
    let stage = Stage::open(gpu, &files);
    assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
    stage
}

fn form(range: &str, fps: &str, format: Format) -> FilmForm {
    FilmForm { range: range.into(), size: "64x36".into(), fps: fps.into(), format, ..FilmForm::default() }
}

fn range(stage: &Stage, form: &FilmForm) -> Box<FilmOrder> {
    let checked = form.check(&stage.session.film_facts(), false);
    Box::new(checked.range.unwrap_or_else(|| panic!("{:?}", checked.errors)))
}

fn live(stage: &Stage, form: &FilmForm) -> Box<FilmOrder> {
    let checked = form.check(&stage.session.film_facts(), false);
    Box::new(checked.live.unwrap_or_else(|| panic!("{:?} {:?}", checked.errors, checked.not_live)))
}

/// Waits until a film is complete, and returns its place.
fn made(stage: &mut Stage) -> PathBuf {
    stage.until("a film", |session| session.film().is_some_and(|film| !film.is_busy()));
    match stage.session.film() {
        Some(FilmView::Done(done)) => done.path.clone(),
        other => panic!("{other:?}; {:?}", stage.session.notices()),
    }
}

/// Returns the files of a folder, or a file alone.
fn files(path: &Path) -> BTreeMap<String, Vec<u8>> {
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    if path.is_file() {
        return [("film".to_owned(), fs::read(path).unwrap())].into();
    }
    let entries = fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path());
    entries.map(|path| (name(&path), fs::read(&path).unwrap())).collect()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn render(stage: &Stage, out: &str, options: &str) -> PathBuf {
    let out = stage.dir.path().join(out);
    let mut eddy = Process::new(env!("CARGO_BIN_EXE_eddy"));
    eddy.arg("render").arg(stage.folder()).args(options.split_whitespace()).arg("--out").arg(&out);
    run(&mut eddy).expect(0);
    out
}

#[test]
fn a_range_has_the_bytes_that_render_writes() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let has_films = has_ffmpeg();
    for (form, options) in [
        (form("3-9:2", "30", Format::Png), "--frames 3-9:2 --fps 30"),
        (form("0-3", "30", Format::Exr), "--frames 0-3 --fps 30 --format exr"),
        (form("0-5", "30", Format::Apng), "--frames 0-5 --fps 30"),
        (form("0-11", "20", Format::Gif), "--frames 0-11 --fps 20"),
        (FilmForm { fade: "0.1".into(), ..form("0.5s", "30", Format::Y4m) }, "--frames 0-14 --fps 30 --loop 0.1"),
        (
            FilmForm { quality: "low".into(), ..form("12-59", "24", Format::Mp4) },
            "--frames 12-59 --fps 24 --quality low",
        ),
        (FilmForm { with_sound: false, ..form("0-9", "30", Format::Mkv) }, "--frames 0-9 --fps 30 --no-audio"),
    ] {
        let needs_ffmpeg = matches!(form.format, Format::Gif | Format::Mp4 | Format::Mkv);
        if needs_ffmpeg && !has_films {
            continue;
        }
        let order = range(&stage, &form);
        stage.session.apply(FilmCommand::MakeFilm(order));
        // What is done meanwhile is not in it.
        stage.session.apply(EditCommand::AssignCustomUniform("level=0.9".into()));
        stage.act(Command::Transport(TransportCommand::Step));
        let path = made(&mut stage);
        stage.session.apply(EditCommand::ResetCustomUniforms);
        let name = if form.format.is_still() { "rendered".into() } else { format!("rendered.{}", form.format.name()) };
        let rendered = render(&stage, &name, &format!("{options} --size 64x36"));
        let (ours, theirs) = (files(&path), files(&rendered));
        assert_eq!(ours.keys().collect::<Vec<_>>(), theirs.keys().collect::<Vec<_>>(), "{form:?}");
        assert!(ours == theirs, "{form:?}: the bytes differ");
        assert!(ours.values().all(|bytes| !bytes.is_empty()));
        let _ = fs::remove_dir_all(&rendered);
    }
    assert!(!stage.folder().join(".eddy").exists());
    assert!(names(&stage.folder()).iter().all(|name| !name.starts_with('.')), "{:?}", names(&stage.folder()));
}

/// A film of a window is drawn on the window's device, in the window's own frames.
#[test]
fn what_is_recorded_live_has_every_frame_and_a_fixed_step() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((64, 36)))));
    let order = live(&stage, &form("0-1", "30", Format::Png));
    stage.session.apply(TransportCommand::Reset);
    stage.session.apply(FilmCommand::MakeFilm(order));
    let mut now = Instant::now();
    let frames = |session: &Session| match session.film() {
        Some(FilmView::Live(live)) => live.frames,
        other => panic!("{other:?}"),
    };
    // Ticks ten times as often as frames are due.
    let mut ticks = 0;
    while frames(&stage.session) < 20 {
        // The clock of this test stands still while the encoder has no room.
        if !matches!(stage.session.film(), Some(FilmView::Live(live)) if live.waits) {
            now += Duration::from_micros(3_333);
            ticks += 1;
        }
        stage.session.tick(now);
        assert!(ticks < 100_000);
        if frames(&stage.session) == 5 {
            stage.session.apply(InputCommand::MouseDown { x: 20.0, y: 10.0 });
        }
    }
    assert!((180..=220).contains(&ticks), "{ticks} ticks of a tenth of a frame");
    stage.act(Command::Film(FilmCommand::StopFilm));
    let folder = made(&mut stage);
    let pictures: Vec<_> =
        names(&folder).iter().map(|name| image::open(folder.join(name)).unwrap().to_rgba8()).collect();
    assert_eq!(pictures.len(), 20);
    let transport = stage.session.transport();
    assert_eq!((transport.fixed_rate, transport.fixed_size), (None, Some((64, 36))), "as they were before");
    // As the command line draws it, with the same hand.
    let out = stage.dir.path().join("rendered");
    let mut eddy = Process::new(env!("CARGO_BIN_EXE_eddy"));
    eddy.arg("render").arg(stage.folder()).args(["--frames", "0-19", "--fps", "30", "--size", "64x36", "--no-project"]);
    run(eddy.args(["--mouse", "5:down 20,10", "--out"]).arg(&out)).expect(0);
    let bytes = |folder: &Path| files(folder).into_values().collect::<Vec<_>>();
    assert!(bytes(&folder) == bytes(&out), "the bytes differ");
    let moved = pictures[4..7]
        .windows(2)
        .map(|pair| i32::from(pair[1].get_pixel(0, 0).0[1]) - i32::from(pair[0].get_pixel(0, 0).0[1]));
    assert!(moved.collect::<Vec<_>>() == [51, 51], "the hand is in it from frame 5 on");
}

/// Ticks thirty times a second of a clock of its own until a recording has so many frames.
fn record_until(stage: &mut Stage, now: &mut Instant, count: u32) {
    for _ in 0..100_000 {
        match stage.session.film() {
            Some(FilmView::Live(live)) if live.frames >= count => return,
            // The clock stands still while the encoder has no room.
            Some(FilmView::Live(live)) if live.waits => {}
            Some(FilmView::Live(_)) => *now += Duration::from_micros(33_334),
            other => panic!("{other:?}"),
        }
        stage.session.tick(*now);
    }
    panic!("{:?}", stage.session.film());
}

/// In the film a second of time begins where the picture becomes dark, and with it a click.
#[test]
fn what_is_recorded_live_has_the_sound_of_the_times_that_it_shows() {
    let Some(gpu) = support::gpu().filter(|_| has_ffmpeg()) else { return };
    let sound = "#iUniform float level = 0.9 in { 0.0, 1.0 }\n\
                 vec2 mainSound(int samp, float time) { return vec2(samp % 44100 < 44 ? level : 0.0); }\n";
    let image = "void mainImage(out vec4 o, in vec2 p) { o = vec4(vec3(fract(iTime)), 1.0); }\n";
    let manifest = "eddy = 1\n[passes.image]\n[passes.sound]\n";
    let files = [("eddy.toml", manifest), ("image.glsl", image), ("sound.glsl", sound)];
    for format in [Format::Mkv, Format::Mp4] {
        let mut stage = Stage::open(gpu.clone(), &files);
        assert!(stage.is_ok(), "{:?}", stage.session.diagnostics());
        stage.act(Command::Canvas(CanvasCommand::SetFixedSize(Some((64, 36)))));
        let order = live(&stage, &form("0-1", "30", format));
        stage.session.apply(TransportCommand::Reset);
        stage.session.apply(FilmCommand::MakeFilm(order));
        let mut now = Instant::now();
        record_until(&mut stage, &mut now, 45);
        // A pause, a jump in time, and another value of a slider.
        stage.session.apply(TransportCommand::Pause);
        stage.session.apply(TransportCommand::Seek(2.5));
        stage.session.apply(EditCommand::AssignCustomUniform("level=0.4".into()));
        for _ in 0..5 {
            now += Duration::from_secs(1);
            stage.session.tick(now);
        }
        stage.session.apply(TransportCommand::Play);
        record_until(&mut stage, &mut now, 80);
        stage.act(Command::Film(FilmCommand::StopFilm));
        let film = made(&mut stage);
        assert!(matches!(stage.session.film(), Some(FilmView::Done(done)) if done.note.is_none()));
        let pixels = decoded(&film);
        let shown: Vec<f64> =
            pixels.chunks_exact(64 * 36 * 3).map(|frame| f64::from(frame[frame.len() / 2]) / 255.0).collect();
        assert_eq!(shown.len(), 80);
        let begins = (0..80).filter(|&n| n == 0 || shown[n] < shown[n - 1] - 0.5);
        let begins: Vec<f64> = begins.map(|n| n as f64 / 30.0 - shown[n]).collect();
        assert_eq!(begins.len(), 3, "{begins:?}");
        let samples = decoded_sound(&film);
        assert!(samples.len().abs_diff(80 * 1_470) < 1_470, "{}", samples.len());
        let mut clicks: Vec<usize> = Vec::new();
        for n in (0..samples.len()).filter(|&n| samples[n].unsigned_abs() > 3_000) {
            if clicks.last().is_none_or(|last| n - last > 4_410) {
                clicks.push(n);
            }
        }
        assert_eq!(clicks.len(), 3, "{format:?}: {clicks:?}");
        for (click, begin) in clicks.iter().zip(&begins) {
            let apart = (*click as f64 / 44_100.0 - begin).abs();
            assert!(apart < 1.0 / 60.0, "{format:?}: a click at {click} is {apart} s from {begin}");
        }
        if format == Format::Mkv {
            // Without loss: the slider's values.
            let levels = clicks.iter().map(|n| (f64::from(samples[n + 10]) / 3_276.8).round()).collect::<Vec<_>>();
            assert_eq!(levels, [9.0, 9.0, 4.0]);
        }
        let streams = probed(&film)["streams"].as_array().unwrap().len();
        assert_eq!(streams, 2);
        assert!(
            names(&stage.folder()).iter().all(|name| !name.starts_with(".eddy-save")),
            "{:?}",
            names(&stage.folder())
        );
    }
}

#[test]
fn a_film_that_is_cancelled_leaves_nothing() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let before = names(&stage.folder());
    let mut formats = vec![Format::Png, Format::Y4m];
    formats.extend(has_ffmpeg().then_some([Format::Mp4, Format::Gif]).into_iter().flatten());
    for format in formats {
        let long = FilmForm { with_sound: false, ..form("0-49999", "30", format) };
        let order = range(&stage, &long);
        stage.session.apply(FilmCommand::MakeFilm(order));
        stage.until(
            "some frames",
            |session| matches!(session.film(), Some(FilmView::UnderWay(progress)) if progress.done > 3),
        );
        stage.act(Command::Film(FilmCommand::CancelFilm));
        assert_eq!(stage.session.film(), Some(FilmView::Cancelled));
        let end = Instant::now() + Duration::from_secs(20);
        while names(&stage.folder()) != before {
            assert!(Instant::now() < end, "{format:?}: {:?}", names(&stage.folder()));
            stage.tick();
        }
        let order = live(&stage, &form("0-1", "30", format));
        stage.session.apply(FilmCommand::MakeFilm(order));
        stage.until("some frames", |session| matches!(session.film(), Some(FilmView::Live(live)) if live.frames > 3));
        stage.act(Command::Film(FilmCommand::CancelFilm));
        let end = Instant::now() + Duration::from_secs(20);
        while names(&stage.folder()) != before {
            assert!(Instant::now() < end, "{format:?}: {:?}", names(&stage.folder()));
            stage.tick();
        }
        stage.act(Command::Transport(TransportCommand::Pause));
    }
}

#[test]
fn a_file_that_came_meanwhile_is_not_replaced_and_one_that_may_be_is() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let path = stage.folder().join("a.y4m");
    let form = FilmForm { file: "a".into(), ..form("0-9", "30", Format::Y4m) };
    let order = range(&stage, &form);
    fs::write(&path, "mine").unwrap();
    stage.session.apply(FilmCommand::MakeFilm(order));
    stage.until("the end", |session| session.film().is_some_and(|film| !film.is_busy()));
    assert!(matches!(stage.session.film(), Some(FilmView::Failed(_))), "{:?}", stage.session.film());
    assert_eq!(fs::read_to_string(&path).unwrap(), "mine");
    assert_eq!(stage.notices(Level::Error).len(), 1);
    let checked = form.check(&stage.session.film_facts(), false);
    assert!(checked.error(FilmField::File).is_some() && checked.range.is_none());
    let order = form.check(&stage.session.film_facts(), true).range.unwrap();
    stage.session.apply(FilmCommand::MakeFilm(Box::new(order)));
    assert_eq!(made(&mut stage), path);
    assert!(fs::read(&path).unwrap().starts_with(b"YUV4MPEG2"));
}

#[test]
fn a_project_that_does_not_compile_is_no_film_and_says_where() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    stage.edit("void mainImage(out vec4 o, in vec2 p) { o = missing; }");
    stage.until_compiled();
    let order = range(&stage, &form("0-9", "30", Format::Png));
    stage.session.apply(FilmCommand::MakeFilm(order));
    stage.until("the end", |session| session.film().is_some_and(|film| !film.is_busy()));
    let Some(FilmView::Failed(why)) = stage.session.film() else { panic!("{:?}", stage.session.film()) };
    assert!(why.contains("missing") && why.contains(":1:"), "{why}");
}

#[test]
fn closing_asks_what_becomes_of_a_film() {
    let Some(gpu) = support::gpu() else { return };
    let mut stage = stage(gpu);
    let asked = |stage: &Stage| match stage.session.question() {
        Some(Question::Film { is_live }) => Some(*is_live),
        None => None,
        other => panic!("{other:?}"),
    };
    let order = range(&stage, &form("0-49999", "30", Format::Y4m));
    stage.act(Command::Film(FilmCommand::MakeFilm(order)));
    stage.act(Command::File(FileCommand::Close));
    assert_eq!(asked(&stage), Some(false));
    stage.act(Command::File(FileCommand::Answer(Answer::Cancel)));
    assert!(stage.session.film().is_some_and(|film| film.is_busy()) && stage.session.take_request().is_none());
    stage.act(Command::File(FileCommand::Close));
    stage.act(Command::File(FileCommand::Answer(Answer::Discard)));
    assert_eq!(stage.session.take_request(), Some(Request::Exit));
    // One that is live is completed first.
    let order = live(&stage, &form("0-1", "30", Format::Y4m));
    stage.session.apply(FilmCommand::MakeFilm(order));
    stage.until("some frames", |session| matches!(session.film(), Some(FilmView::Live(live)) if live.frames > 3));
    stage.session.apply(FileCommand::Close);
    assert_eq!(asked(&stage), Some(true));
    stage.session.apply(FileCommand::Answer(Answer::Finish));
    let path = made(&mut stage);
    assert_eq!(stage.session.take_request(), Some(Request::Exit));
    assert!(fs::read(path).unwrap().starts_with(b"YUV4MPEG2"));
}
