//! Every pass of every preset, walker compared with device: at three frames of a drag, at some pixels each, within the
//! bounds of a table that also gives the reasons.
//!
//! `EDDY_WALK_PIXELS=200` walks this number of pixels per pass and frame. `cargo test --test it walker_presets --
//! --nocapture` prints the results.

use crate::support::{
    env::number,
    explained::Explained,
    walked::{Pixel, is_same},
    *,
};
use eddy::{
    debugger::trace::{Extent, Tracer, ulps},
    engine::{BuildOptions, FrameInputs, PassInputs, Pixels, Sources},
    gpu::Gpu,
    media,
    project::{self, Pass, PassName, Project, TexelFormat, presets},
};
use std::collections::BTreeSet;

const SIZE: (u32, u32) = (64, 36);
const FRAMES: [i32; 3] = [3, 30, 120];

/// The bounds of every pixel, in addition to one step of a format other than 32-bit float: a distance in ULPs, or, near
/// zero, a difference. They cover the last bits of functions such as `sin`, and reordered sums.
const NEAR_ULPS: u32 = 64;
const NEAR: f32 = 4e-6;

/// Pixels that may differ by more.
struct Exception {
    preset: &'static str,
    pass: &'static str,
    /// The largest difference, relative to values above 1.
    absolute: f32,
    /// The number of pixels per thousand.
    share: usize,
    /// The allowed reasons, one of which the walker must find.
    reasons: &'static [&'static str],
}

const fn exception(
    preset: &'static str,
    pass: &'static str,
    (absolute, share): (f32, usize),
    reasons: &'static [&'static str],
) -> Exception {
    Exception { preset, pass, absolute, share, reasons }
}

/// The walker's reasons for a value whose error in single precision is as large as the device's difference.
const ROUNDING: &[&str] = &["rounding", "ill-conditioned"];
const FILTERED: &[&str] = &["filtered"];

/// Twice the largest differences at 200 pixels per pass and frame.
const EXCEPTIONS: &[Exception] = &[
    // Noise by hashes, which take the fraction of a large product: errors in the last bits are magnified by its size.
    exception("bloom", "Buffer A", (7e-4, 330), ROUNDING),
    exception("bloom-sized", "Buffer A", (2e-3, 30), ROUNDING),
    exception("gallery-of-tricks", "Buffer progress", (2e-4, 80), ROUNDING),
    exception("gbuffer-edges", "Image", (2e-3, 700), ROUNDING),
    // Rays marched along a surface or ending at its edge, and normals by differences of distances.
    exception("scene-bloom-taa", "Buffer A", (1e-4, 5), ROUNDING),
    exception("gbuffer-edges", "Buffer A", (3e-5, 80), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer A", (3e-5, 80), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer B", (1e-2, 5), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer light", (3e-5, 20), ROUNDING),
    // A filtered 8-bit picture.
    exception("toon-outline", "Image", (1.5 / 255.0, 280), FILTERED),
];

/// The results of a pass.
#[derive(Clone, Debug, Default)]
struct Found {
    walked: usize,
    same: usize,
    /// The largest distance of pixels within the ULP bound.
    ulps: u32,
    /// The largest difference of all pixels.
    absolute: f32,
    outliers: Vec<Outlier>,
}

#[derive(Clone, Debug)]
struct Outlier {
    place: String,
    why: String,
}

/// Returns a target's step at a value; 0 for 32-bit floats.
fn step(format: TexelFormat, at: f32) -> f32 {
    match format {
        TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8 => 1.0 / 255.0,
        // 11 bits, and no exponent below -14.
        TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f => at.abs().max(6.2e-5) / 1024.0,
        _ => 0.0,
    }
}

/// Returns the value in the range of an 8-bit target.
fn stored(format: TexelFormat, value: f32) -> f32 {
    if step(format, 1.0) == 1.0 / 255.0 { value.clamp(0.0, 1.0) } else { value }
}

/// Returns whether the pass computes a texel, and does not overwrite it by its boundary.
fn is_computed(pass: &Pass, size: (u32, u32), (x, y): Pixel) -> bool {
    let is_inside = pass.settings.region.is_none_or(|region| {
        let columns = region.x..region.x + region.width;
        columns.contains(&x) && (region.y..region.y + region.height).contains(&y)
    });
    let edge = pass.settings.boundary.as_ref().map_or(0, |boundary| boundary.width);
    let is_within = |at: u32, size: u32| at >= edge && at + edge < size;
    is_inside && is_within(x, size.0) && is_within(y, size.1)
}

pub(crate) fn inputs(frame: i32) -> FrameInputs {
    FrameInputs { mouse: [20.0 + 4.0 * frame as f32, 18.0, 20.0, 18.0], ..FrameInputs::at_fixed_step(frame, 60.0) }
}

fn walk_pass(
    (project, sources): (&Project, &Sources<'_>),
    (index, frame): (usize, i32),
    (read, drawn): (&PassInputs, &Pixels),
    found: &mut Found,
) {
    let pass = &project.passes[index];
    let format = pass.formats()[0];
    let extent = Extent { steps: 0, ..Extent::default() };
    let tracer = Tracer::new(sources, index, read, extent).unwrap_or_else(|e| panic!("{}: {e}", pass.id.title()));
    let (width, height) = read.size;
    let spread = (0..number("EDDY_WALK_PIXELS", 4) as u32).map(|n| n * 1_597 % (width * height));
    for pixel in spread.map(|at| (at % width, at / width)).filter(|&pixel| is_computed(pass, read.size, pixel)) {
        let trace = tracer.trace(pixel).unwrap_or_else(|e| panic!("{} at {pixel:?}: {e}", pass.id.title()));
        // A discarded pixel keeps its previous value.
        let Some(value) = trace.value else { continue };
        let drawn = texel(drawn, pixel.0, pixel.1);
        found.walked += 1;
        let pairs = || value.into_iter().map(|x| stored(format, x)).zip(drawn).take(format.components());
        found.same += usize::from(pairs().all(|(a, b)| is_same(a, b)));
        let mut largest = 0.0f32;
        for (a, b) in pairs().filter(|&(a, b)| !is_same(a, b)) {
            let difference = (a - b).abs() - step(format, b);
            let difference = if difference.is_nan() { f32::INFINITY } else { difference.max(0.0) / b.abs().max(1.0) };
            found.absolute = found.absolute.max(difference);
            if difference > NEAR {
                match ulps(a, b) {
                    few @ ..=NEAR_ULPS => found.ulps = found.ulps.max(few),
                    _ => largest = largest.max(difference),
                }
            }
        }
        if largest > 0.0 {
            let why = Explained { sources, index, read }.why(pixel, largest.into());
            found
                .outliers
                .push(Outlier { place: format!("frame {frame} at {pixel:?}: {value:?}, drawn {drawn:?}"), why });
        }
    }
}

/// Returns the errors of a pass, given the exceptions.
fn judge(preset: &str, id: &PassName, found: &Found) -> Vec<String> {
    let title = id.title();
    let exception = EXCEPTIONS.iter().find(|exception| exception.preset == preset && exception.pass == title);
    let Some(Exception { absolute, share, reasons, .. }) = exception else {
        return found.outliers.iter().map(|o| format!("{preset}, {title}, {}: {}", o.place, o.why)).collect();
    };
    let is_unnamed = |outlier: &&Outlier| !reasons.iter().any(|reason| outlier.why.starts_with(reason));
    let mut wrong: Vec<String> = found
        .outliers
        .iter()
        .filter(is_unnamed)
        .map(|o| format!("{preset}, {title}, {}: {}, not {reasons:?}", o.place, o.why))
        .collect();
    if found.absolute > *absolute {
        wrong.push(format!("{preset}, {title}: off by {}, not {absolute}", found.absolute));
    }
    // With few pixels, one or two exceptions may exceed the share by chance.
    if found.outliers.len() > 2 + share * found.walked / 1000 {
        wrong.push(format!("{preset}, {title}: {} of {} are off", found.outliers.len(), found.walked));
    }
    wrong
}

/// Draws a preset, and walks its passes at each of the frames.
fn walk_preset(gpu: &Gpu, name: &str) -> Vec<(PassName, Found)> {
    let mut project = project::presets::load(name).unwrap().project;
    // A pass that is not drawn runs no code.
    project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
    let (media, _) = media::gather(&project, None);
    let sources = Sources::new(&project);
    let wanted: Vec<PassName> =
        project.passes.iter().map(|pass| pass.id.clone()).filter(PassName::is_picture).collect();
    let options = BuildOptions { requested: wanted.clone(), skip: false, ..BuildOptions::default() };
    let mut engine = engine_with(gpu, &project, &media, &options, SIZE);
    let mut found: Vec<(PassName, Found)> = wanted.into_iter().map(|id| (id, Found::default())).collect();
    // Without state a frame does not depend on earlier ones.
    let has_state = !project.stateful_passes().is_empty();
    let mut drawn_to = 0;
    for frame in FRAMES {
        let before = if has_state { drawn_to..frame } else { 0..0 };
        before.for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
        drawn_to = frame + 1;
        let before = engine.snapshot().unwrap();
        for (index, (id, found)) in found.iter_mut().enumerate() {
            // Passes of a group overwrite the inputs of others in it, so each is inspected in its own drawing.
            assert!(engine.restore(&before));
            let read = inspect(&mut engine, &inputs(frame), id);
            let drawn = engine.read(id).unwrap();
            walk_pass((&project, &sources), (index, frame), (&read, &drawn), found);
        }
    }
    found
}

/// Two tests, so that two cores share the presets.
#[test]
fn even_presets_match_the_device() {
    walk_presets(0);
}

#[test]
fn odd_presets_match_the_device() {
    walk_presets(1);
}

/// Walks every second preset, starting at `first`.
fn walk_presets(first: usize) {
    let Some(gpu) = gpu() else { return };
    let (mut wrong, mut all) = (Vec::new(), Found::default());
    for name in presets::names().iter().skip(first).step_by(2) {
        for (id, found) in walk_preset(&gpu, name) {
            let Found { walked, same, ulps, absolute, outliers } = &found;
            let why: BTreeSet<&str> = outliers.iter().map(|outlier| outlier.why.as_str()).collect();
            let title = id.title();
            println!(
                "| {name} | {title} | {walked} | {same} | {ulps} | {absolute:.1e} | {} | {why:?} |",
                outliers.len()
            );
            wrong.extend(judge(name, &id, &found));
            all.walked += walked;
            all.same += same;
            all.outliers.extend(found.outliers);
        }
    }
    println!("{} pixels, {} the same in every bit, {} not near", all.walked, all.same, all.outliers.len());
    assert!(all.walked > 100, "{} pixels", all.walked);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The control: a pass that is walked with a changed number is reported.
#[test]
fn a_changed_preset_is_detected() {
    let Some(gpu) = gpu() else { return };
    let project = project::presets::load("feedback").unwrap().project;
    let mut engine = ran(&gpu, &project, SIZE, 4);
    let index = project.image_index().unwrap();
    let mut other = project.clone();
    let text = format!(
        "#define mainImage preset\n{}\n#undef mainImage\nvoid mainImage(out vec4 o, in vec2 p) {{ preset(o, p); o *= \
         1.0001; }}\n",
        project.passes[index].source.text
    );
    other.passes[index].source.text = text.into();
    let (read, drawn) = (engine.inspect(&PassName::image()).unwrap(), engine.read_image().unwrap());
    for (project, is_right) in [(&project, true), (&other, false)] {
        let mut found = Found::default();
        walk_pass((project, &Sources::new(project)), (index, 3), (&read, &drawn), &mut found);
        assert_eq!(judge("feedback", &PassName::image(), &found).is_empty(), is_right, "{found:?}");
    }
}
