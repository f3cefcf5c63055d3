//! Shared parts of the tests of presets: presets with changed texts, frames with a mouse, buffers that are read back.

use super::{Engines, buffer};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs, Pixels},
    gpu::Gpu,
    media::MediaSet,
    project::{CustomUniformValues, PassName, Project, presets},
};

pub(crate) fn preset(name: &str) -> Project {
    presets::load(name).unwrap_or_else(|e| panic!("{e}")).project
}

/// Returns a preset with its sliders set.
pub(crate) fn preset_with(name: &str, custom_uniforms: &[&str]) -> Project {
    let mut project = preset(name);
    turn(&mut project, custom_uniforms);
    project
}

pub(crate) fn turn(project: &mut Project, custom_uniforms: &[&str]) {
    for custom_uniform in custom_uniforms {
        project.set_custom_uniform(custom_uniform).unwrap();
    }
}

/// Returns values to set on the sliders of a running program.
pub(crate) fn values(name: &str, custom_uniforms: &[&str]) -> CustomUniformValues {
    preset_with(name, custom_uniforms).custom_uniform_values
}

/// Replaces `old` by `new` in a pass's text, which must contain it, so that a change of the preset cannot disable a
/// test.
pub(crate) fn patch(project: &mut Project, id: &PassName, old: &str, new: &str) {
    let source = &mut project.pass_mut(id).unwrap().source;
    assert!(source.text.contains(old), "{} no longer contains `{old}`", source.name);
    source.text = source.text.replace(old, new).into();
}

/// The same, in an included file.
pub(crate) fn patch_file(project: &mut Project, file: &str, old: &str, new: &str) {
    let included = project.includes.iter_mut().find(|i| i.source.name == file).unwrap();
    assert!(included.source.text.contains(old), "{file} no longer contains `{old}`");
    included.source.text = included.source.text.replace(old, new).into();
}

/// Lets `code` modify what a pass writes: it sees `o`, the texel that the preset writes, and its address `p`.
pub(crate) fn overwrite(project: &mut Project, name: &str, code: &str) {
    let source = &mut project.pass_mut(&buffer(name)).unwrap().source;
    source.text = format!(
        "#define mainImage presetImage\n{}\n#undef mainImage\nvoid mainImage(out vec4 o, in vec2 c) {{\n\
         presetImage(o, c);\nivec2 p = ivec2(c);\n{code}\n}}\n",
        source.text
    )
    .into();
}

/// Numbers that are not finite, computed from iFrame so that no compiler can know them: a NaN and both infinities.
pub(crate) const BROKEN: [&str; 3] = ["0x7fc00000u", "0x7f800000u", "0xff800000u"];

/// Writes one of [`BROKEN`] into one texel of a pass in frame `frame`.
pub(crate) fn break_texel(project: &mut Project, name: &str, (x, y): (u32, u32), frame: i32, number: &str) {
    let code = format!(
        "if (iFrame == {frame} && p == ivec2({x}, {y})) o = vec4(uintBitsToFloat({number} + uint(iFrame - {frame})));"
    );
    overwrite(project, name, &code);
}

/// Returns the input of frame `frame` with the mouse held at `at` since it was pressed at `from`, or never pressed.
pub(crate) fn held(frame: i32, mouse: Option<([f32; 2], [f32; 2])>) -> FrameInputs {
    let mut inputs = FrameInputs::at_fixed_step(frame, 60.0);
    inputs.mouse = match mouse {
        Some((from, at)) => [at[0], at[1], from[0], -from[1]],
        None => [0.0, 0.0, -0.0, -0.0],
    };
    inputs
}

pub(crate) fn untouched(frame: i32) -> FrameInputs {
    held(frame, None)
}

/// Returns the input of a drag from (12, 9) to the right, held in frames 10 to 24.
pub(crate) fn drag(frame: i32) -> FrameInputs {
    let moved = (frame - 10).clamp(0, 14) as f32;
    held(frame, (10..25).contains(&frame).then_some(([12.0, 9.0], [12.0 + moved, 9.0])))
}

pub(crate) fn draw(engine: &mut Engine, frames: std::ops::Range<i32>, inputs: impl Fn(i32) -> FrameInputs) {
    for frame in frames {
        engine.draw(&inputs(frame)).unwrap();
    }
}

pub(crate) fn bits(pixels: &Pixels) -> Vec<[u32; 4]> {
    pixels.texels.iter().map(|t| t.map(f32::to_bits)).collect()
}

pub(crate) fn buffers(project: &Project) -> impl Iterator<Item = &PassName> {
    project.passes.iter().map(|p| &p.id).filter(|id| id.is_picture())
}

/// Returns an engine in which every pass can be read.
pub(crate) fn whole(gpu: &Gpu, project: &Project, skip: bool, size: (u32, u32)) -> Engine {
    Engines::new(gpu).whole(project, skip, size)
}

impl Engines {
    pub(crate) fn whole(&mut self, project: &Project, skip: bool, size: (u32, u32)) -> Engine {
        let options = BuildOptions { requested: buffers(project).cloned().collect(), skip, ..BuildOptions::default() };
        self.with(project, &MediaSet::new(), &options, size)
    }
}

/// The same, after these frames.
pub(crate) fn drawn(
    gpu: &Gpu,
    project: &Project,
    skip: bool,
    size: (u32, u32),
    frames: std::ops::Range<i32>,
    inputs: impl Fn(i32) -> FrameInputs,
) -> Engine {
    let mut engine = whole(gpu, project, skip, size);
    draw(&mut engine, frames, inputs);
    engine
}

/// Returns the mean of a component over the texels for which `at` returns true, in f64.
pub(crate) fn mean(pixels: &Pixels, component: usize, at: impl Fn(u32, u32) -> bool) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (i, texel) in pixels.texels.iter().enumerate() {
        if at(i as u32 % pixels.width, i as u32 / pixels.width) {
            sum += f64::from(texel[component]);
            count += 1.0;
        }
    }
    sum / count
}

pub(crate) fn all_finite(pixels: &Pixels) -> bool {
    pixels.texels.iter().flatten().all(|v| v.is_finite())
}
