//! Compares programs in the languages of other hosts with pictures that Chromium's WebGL draws of them:
//! `tests/dialects/ROW/NAME.png` for `NAME.frag` (`.fs` for ISF, `.glsl` for Bonzomatic). `tests/dialects/README.md`
//! describes the comments in a program that set its inputs, and how the pictures are drawn.

use crate::support::gpu;
use eddy::{
    audio::{BINS, Spectrum},
    engine::{BuildOptions, Builder, Engine},
    gpu::Gpu,
    media,
    playback::{
        date,
        script::{ScriptedInputs, parse_mouse},
    },
    project::{self, Dialect, Project, ShaderForm},
};
use image::RgbaImage;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    sync::Arc,
};

const SIZE: (u32, u32) = (32, 18);
/// The frame that is compared unless a comment names another.
const FRAME: i32 = 7;
/// By how much a channel may differ, in steps of 1/255: both sides round, and filter with weights of 8 bits.
const TOLERANCE: u8 = 2;
/// A row with fewer programs has lost some.
const PROGRAMS: usize = 10;

/// The rows with programs, and the extensions of these.
pub(crate) const ROWS: [(Dialect, &str); 6] = [
    (Dialect::GlslViewer, "frag"),
    (Dialect::GlslSandbox, "frag"),
    (Dialect::Bonzomatic, "glsl"),
    (Dialect::Twigl, "frag"),
    (Dialect::Isf, "fs"),
    (Dialect::Plain, "frag"),
];

/// Programs that Eddy draws differently, and why. Each must differ, so that the list stays true.
const DIFFERENCES: &[(&str, &str)] = &[
    ("bonzomatic/texel", "Bonzomatic reads linear colours of its sRGB pictures, Eddy the colours in the file"),
    ("bonzomatic/texture", "the same"),
    ("isf/input_defaults", "Eddy accepts a default outside the range, and takes the minimum for a missing one"),
    ("isf/missing_bool", "a bool without a default is false"),
];

/// The inputs that the comments of a program set.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Inputs {
    frame: i32,
    /// The same as `--mouse` and `--date` of `eddy render`.
    mouse: String,
    date: String,
    spectrum: Option<(u8, u8)>,
}

impl Inputs {
    pub(crate) fn of(text: &str) -> Result<Inputs, String> {
        let mut inputs = Inputs { frame: FRAME, ..Inputs::default() };
        for line in text.lines().filter_map(|line| line.strip_prefix("// ")) {
            let Some((name, value)) = line.split_once(": ") else { continue };
            let invalid = || format!("`// {line}` cannot be read");
            match name {
                "frame" => inputs.frame = value.parse().map_err(|_| invalid())?,
                "mouse" => inputs.mouse = format!("0:down {value}"),
                "pointer" => inputs.mouse = format!("0:move {value}"),
                "date" => value.clone_into(&mut inputs.date),
                "spectrum" => {
                    let (level, bins) = value.split_once(',').ok_or_else(invalid)?;
                    let number = |text: &str| text.parse().map_err(|_| invalid());
                    inputs.spectrum = Some((number(level)?, number(bins)?.max(1)));
                }
                _ => {}
            }
        }
        Ok(inputs)
    }

    /// Returns them with the button pressed wherever the pointer moves.
    pub(crate) fn pressed(mut self) -> Inputs {
        self.mouse = self.mouse.replace("0:move", "0:down");
        self
    }

    /// Returns the texture of the microphone: a spectrum that falls by one every so many bins, and no wave.
    fn microphone(&self) -> Option<Arc<Spectrum>> {
        let (level, bins) = self.spectrum?;
        let byte =
            |n: usize| if n < BINS { usize::from(level).saturating_sub(n / usize::from(bins)) as u8 } else { 128 };
        Some(Arc::new(std::array::from_fn(byte)))
    }
}

fn folder(row: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/dialects").join(row)
}

/// Returns the files of a row with this extension.
pub(crate) fn files_of(row: &str, extension: &str) -> BTreeSet<PathBuf> {
    let paths = fs::read_dir(folder(row)).unwrap().map(|entry| entry.unwrap().path());
    paths.filter(|path| path.extension().is_some_and(|e| e == extension)).collect()
}

/// Returns the program's picture as Eddy draws it.
fn draw(gpu: &Gpu, path: &Path) -> Result<RgbaImage, String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let settings = Inputs::of(&text)?;
    let loaded = project::load(&path.display().to_string()).map_err(|e| e.to_string())?;
    draw_project(gpu, &loaded.project, &settings)
}

/// Returns the picture of a project with these inputs.
pub(crate) fn draw_project(gpu: &Gpu, project: &Project, settings: &Inputs) -> Result<RgbaImage, String> {
    let (media, warnings) = media::gather(project, None);
    if let Some(warning) = warnings.first() {
        return Err(warning.message.clone());
    }
    let options = BuildOptions::default();
    let built = Builder::new(gpu.clone()).build(project, &media, &options);
    let mut engine = Engine::new(gpu.clone(), SIZE.0, SIZE.1).map_err(|e| e.to_string())?;
    engine.set_program(built.map_err(|e| format!("{e}: {e:?}"))?.program).map_err(|e| e.to_string())?;
    let date = Some(&settings.date).filter(|date| !date.is_empty()).map(|date| date::parse(date));
    let mut inputs = ScriptedInputs::new(60.0)
        .with_mouse(parse_mouse(&settings.mouse).map_err(|e| format!("mouse, {e}"))?)
        .with_date(date.transpose().map_err(|e| e.to_string())?);
    while inputs.frame() <= settings.frame {
        let mut frame = inputs.next_frame();
        frame.microphone = settings.microphone();
        engine.draw(&frame).map_err(|e| e.to_string())?;
    }
    let pixels = engine.read_image().map_err(|e| e.to_string())?;
    Ok(RgbaImage::from_raw(SIZE.0, SIZE.1, pixels.to_rgba8()).unwrap())
}

/// Returns the first pixel that differs by more than the tolerance.
fn difference(reference: &RgbaImage, drawn: &RgbaImage) -> Option<String> {
    if reference.dimensions() != drawn.dimensions() {
        return Some(format!("{:?} pixels in the reference, {:?} drawn", reference.dimensions(), drawn.dimensions()));
    }
    let mut pixels = reference.enumerate_pixels().zip(drawn.pixels());
    pixels.find_map(|((x, y, expected), found)| {
        let is_near = (0..3).all(|i| expected.0[i].abs_diff(found.0[i]) <= TOLERANCE);
        let y = reference.height() - 1 - y;
        (!is_near).then(|| format!("pixel ({x}, {y}) is {:?}, expected {:?}", &found.0[..3], &expected.0[..3]))
    })
}

/// Returns an error unless the program is drawn like its reference picture.
fn check(gpu: &Gpu, path: &Path) -> Result<(), String> {
    let picture = path.with_extension("png");
    let reference = image::open(&picture).map_err(|e| format!("{}: {e}", picture.display()))?.to_rgba8();
    match difference(&reference, &draw(gpu, path)?) {
        None => Ok(()),
        Some(problem) => Err(problem),
    }
}

fn check_row(dialect: Dialect) {
    let (_, extension) = ROWS.into_iter().find(|(row, _)| *row == dialect).unwrap();
    let row = dialect.name();
    let programs = files_of(row, extension);
    assert!(programs.len() >= PROGRAMS, "tests/dialects/{row} has {} programs, at least {PROGRAMS}", programs.len());
    let pictures = files_of(row, "png");
    let expected: BTreeSet<PathBuf> = programs.iter().map(|program| program.with_extension("png")).collect();
    let missing: Vec<&PathBuf> = expected.difference(&pictures).collect();
    assert!(missing.is_empty(), "draw these pictures with tests/dialects/chromium.py: {missing:?}");
    let unused: Vec<&PathBuf> = pictures.difference(&expected).collect();
    assert!(unused.is_empty(), "remove these pictures, which belong to no program: {unused:?}");
    let Some(gpu) = gpu() else { return };
    let mut problems = Vec::new();
    for path in &programs {
        let name = format!("{row}/{}", path.file_stem().unwrap().to_string_lossy());
        let known = DIFFERENCES.iter().find(|(program, _)| *program == name);
        match (check(&gpu, path), known) {
            (Ok(()), None) | (Err(_), Some(_)) => {}
            (Ok(()), Some(_)) => problems.push(format!("{name} agrees: remove it from DIFFERENCES")),
            (Err(problem), None) => problems.push(format!("{name}: {problem}")),
        }
    }
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

#[test]
fn glslviewer_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::GlslViewer);
}

#[test]
fn glslsandbox_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::GlslSandbox);
}

#[test]
fn bonzomatic_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::Bonzomatic);
}

#[test]
fn twigl_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::Twigl);
}

#[test]
fn isf_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::Isf);
}

#[test]
fn plain_programs_are_drawn_as_in_webgl() {
    check_row(Dialect::Plain);
}

#[test]
fn every_program_is_recognised_as_one_of_its_row() {
    for (dialect, extension) in ROWS {
        for path in files_of(dialect.name(), extension) {
            let text = fs::read_to_string(&path).unwrap();
            assert_eq!(ShaderForm::of(&path, &text), ShaderForm::Program(dialect), "{}", path.display());
        }
    }
}

#[test]
fn comments_set_the_inputs_of_a_program() {
    let text =
        "#version 330\n// mouse: 20,5\n// Not an input: text.\n// date: 2026-11-29T18:30:12\n// spectrum: 200,4\n";
    let inputs = Inputs::of(text).unwrap();
    let expected = Inputs {
        frame: FRAME,
        mouse: "0:down 20,5".into(),
        date: "2026-11-29T18:30:12".into(),
        spectrum: Some((200, 4)),
    };
    assert_eq!(inputs, expected);
    let bytes = inputs.microphone().unwrap();
    assert_eq!([bytes[0], bytes[4], bytes[BINS - 1], bytes[BINS]], [200, 199, 73, 128]);
    assert_eq!(Inputs::of("// pointer: 1,2").unwrap().mouse, "0:move 1,2");
    assert!(Inputs::of("// frame: seven").is_err() && Inputs::of("// spectrum: 300,1").is_err());
}

#[test]
fn a_pixel_beyond_the_tolerance_is_a_difference() {
    let reference = RgbaImage::from_fn(4, 3, |x, y| image::Rgba([40 * x as u8, 60 * y as u8, 9, 255]));
    let brighter = |by: u8| {
        let mut picture = reference.clone();
        picture.get_pixel_mut(1, 2).0[1] += by;
        picture
    };
    assert_eq!(difference(&reference, &brighter(2)), None);
    assert_eq!(difference(&reference, &brighter(3)).unwrap(), "pixel (1, 0) is [40, 123, 9], expected [40, 120, 9]");
    assert!(difference(&reference, &RgbaImage::new(3, 4)).unwrap().contains("(3, 4) drawn"));
}
