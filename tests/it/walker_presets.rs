//! Every pass of every preset, walker against device: at three frames of a drag, each at some pixels, within what a
//! table allows and says why.
//!
//! `EDDY_WALK_PIXELS=200` walks so many pixels a pass and frame instead of a few.
//! `cargo test --test it walker_presets -- --nocapture` prints what was found.

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

/// What every pixel is within, beside one step of a format that is no float of 32 bits: so many numbers of single
/// precision, or, near zero, a difference. That is what the last bits of `sin` and its like, and sums in another order,
/// come to.
const NEAR_ULPS: u32 = 64;
const NEAR: f32 = 4e-6;

/// Pixels that may be off by more.
struct Exception {
    preset: &'static str,
    pass: &'static str,
    /// How far, relative to values above 1.
    absolute: f32,
    /// How many in a thousand.
    share: usize,
    /// What the walker must find to be the reason, one of these.
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

/// What the walker says of a value that single precision has as far from the exact one as the device has.
const ROUNDING: &[&str] = &["rounding", "ill-conditioned"];
const FILTERED: &[&str] = &["filtered"];

/// Twice of what was seen at 200 pixels of a pass and frame.
const EXCEPTIONS: &[Exception] = &[
    // Noise by hashes, which take the fraction of a large product: last bits come out as many times larger.
    exception("bloom", "Buffer A", (7e-4, 330), ROUNDING),
    exception("bloom-sized", "Buffer A", (2e-3, 30), ROUNDING),
    exception("gallery-of-tricks", "Buffer progress", (2e-4, 80), ROUNDING),
    exception("gbuffer-edges", "Image", (2e-3, 700), ROUNDING),
    // Rays that are marched along a surface or end at its edge, and normals by differences of distances.
    exception("scene-bloom-taa", "Buffer A", (1e-4, 5), ROUNDING),
    exception("gbuffer-edges", "Buffer A", (3e-5, 80), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer A", (3e-5, 80), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer B", (1e-2, 5), ROUNDING),
    exception("gbuffer-ssao-ssr", "Buffer light", (3e-5, 20), ROUNDING),
    // A picture of 8 bits, filtered.
    exception("toon-outline", "Image", (1.5 / 255.0, 280), FILTERED),
];

/// What a pass came to.
#[derive(Clone, Debug, Default)]
struct Found {
    walked: usize,
    same: usize,
    /// Of those that are near by them.
    ulps: u32,
    /// Of all.
    absolute: f32,
    off: Vec<Off>,
}

#[derive(Clone, Debug)]
struct Off {
    place: String,
    why: String,
}

/// A step of what a target stores at a value; 0 for floats of 32 bits.
fn step(format: TexelFormat, at: f32) -> f32 {
    match format {
        TexelFormat::R8 | TexelFormat::Rg8 | TexelFormat::Rgba8 => 1.0 / 255.0,
        // 11 bits, and no exponent below -14.
        TexelFormat::R16f | TexelFormat::Rg16f | TexelFormat::Rgba16f => at.abs().max(6.2e-5) / 1024.0,
        _ => 0.0,
    }
}

/// The nearest value that a target of 8 bits stores.
fn stored(format: TexelFormat, value: f32) -> f32 {
    if step(format, 1.0) == 1.0 / 255.0 { value.clamp(0.0, 1.0) } else { value }
}

/// Texels that a pass leaves as it computes them.
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
        // What is discarded keeps what it held.
        let Some(value) = trace.value else { continue };
        let drawn = texel(drawn, pixel.0, pixel.1);
        found.walked += 1;
        let pairs = || value.into_iter().map(|x| stored(format, x)).zip(drawn).take(format.components());
        found.same += usize::from(pairs().all(|(a, b)| is_same(a, b)));
        let mut most = 0.0f32;
        for (a, b) in pairs().filter(|&(a, b)| !is_same(a, b)) {
            let apart = (a - b).abs() - step(format, b);
            let apart = if apart.is_nan() { f32::INFINITY } else { apart.max(0.0) / b.abs().max(1.0) };
            found.absolute = found.absolute.max(apart);
            if apart > NEAR {
                match ulps(a, b) {
                    few @ ..=NEAR_ULPS => found.ulps = found.ulps.max(few),
                    _ => most = most.max(apart),
                }
            }
        }
        if most > 0.0 {
            let why = Explained { sources, index, read }.why(pixel, most.into());
            found.off.push(Off { place: format!("frame {frame} at {pixel:?}: {value:?}, drawn {drawn:?}"), why });
        }
    }
}

/// What is wrong with a pass, against the exceptions.
fn judge(preset: &str, id: &PassName, found: &Found) -> Vec<String> {
    let title = id.title();
    let exception = EXCEPTIONS.iter().find(|exception| exception.preset == preset && exception.pass == title);
    let Some(Exception { absolute, share, reasons, .. }) = exception else {
        return found.off.iter().map(|off| format!("{preset}, {title}, {}: {}", off.place, off.why)).collect();
    };
    let is_named = |off: &&Off| !reasons.iter().any(|reason| off.why.starts_with(reason));
    let mut wrong: Vec<String> = found
        .off
        .iter()
        .filter(is_named)
        .map(|off| format!("{preset}, {title}, {}: {}, not {reasons:?}", off.place, off.why))
        .collect();
    if found.absolute > *absolute {
        wrong.push(format!("{preset}, {title}: off by {}, not {absolute}", found.absolute));
    }
    // Of a few pixels one may happen to be among them.
    if found.off.len() > 2 + share * found.walked / 1000 {
        wrong.push(format!("{preset}, {title}: {} of {} are off", found.off.len(), found.walked));
    }
    wrong
}

/// Draws a preset, and walks through its passes at each of the frames.
fn walk_preset(gpu: &Gpu, name: &str) -> Vec<(PassName, Found)> {
    let mut project = project::presets::load(name).unwrap().project;
    // Nothing runs for the texels of a pass that is off.
    project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
    let (media, _) = media::gather(&project, None);
    let sources = Sources::new(&project);
    let wanted: Vec<PassName> =
        project.passes.iter().map(|pass| pass.id.clone()).filter(PassName::is_picture).collect();
    let options = BuildOptions { requested: wanted.clone(), skip: false, ..BuildOptions::default() };
    let mut engine = engine_with(gpu, &project, &media, &options, SIZE);
    let mut found: Vec<(PassName, Found)> = wanted.into_iter().map(|id| (id, Found::default())).collect();
    // Without state a frame is what it is whatever was drawn before.
    let has_state = !project.stateful_passes().is_empty();
    let mut drawn_to = 0;
    for frame in FRAMES {
        let before = if has_state { drawn_to..frame } else { 0..0 };
        before.for_each(|frame| assert!(engine.draw(&inputs(frame)).is_ok()));
        drawn_to = frame + 1;
        let before = engine.snapshot().unwrap();
        for (index, (id, found)) in found.iter_mut().enumerate() {
            // Passes of one group overwrite what others of it have read, so each is looked at in its own drawing.
            assert!(engine.restore(&before));
            let read = inspect(&mut engine, &inputs(frame), id);
            let drawn = engine.read(id).unwrap();
            walk_pass((&project, &sources), (index, frame), (&read, &drawn), found);
        }
    }
    found
}

/// A test each, so that two cores share the presets.
#[test]
fn presets_are_walked_to_what_the_device_draws() {
    walk_presets(0);
}

#[test]
fn the_other_presets_are_walked_to_what_the_device_draws() {
    walk_presets(1);
}

/// Walks every second preset, from the `first` on.
fn walk_presets(first: usize) {
    let Some(gpu) = gpu() else { return };
    let (mut wrong, mut all) = (Vec::new(), Found::default());
    for name in presets::names().iter().skip(first).step_by(2) {
        for (id, found) in walk_preset(&gpu, name) {
            let Found { walked, same, ulps, absolute, off } = &found;
            let why: BTreeSet<&str> = off.iter().map(|off| off.why.as_str()).collect();
            let title = id.title();
            println!("| {name} | {title} | {walked} | {same} | {ulps} | {absolute:.1e} | {} | {why:?} |", off.len());
            wrong.extend(judge(name, &id, &found));
            all.walked += walked;
            all.same += same;
            all.off.extend(found.off);
        }
    }
    println!("{} pixels, {} the same in every bit, {} not near", all.walked, all.same, all.off.len());
    assert!(all.walked > 100, "{} pixels", all.walked);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The control: a pass that is walked with another number in it is found to be off.
#[test]
fn a_preset_that_is_not_what_is_drawn_is_seen() {
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
