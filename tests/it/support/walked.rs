//! The walker beside what a device draws.

use super::texel;
use bytemuck::Zeroable;
use eddy::{
    debugger::trace::{Extent, Tracer},
    engine::{Engine, PassInputs, Sources, TextureCopy},
    glsl::interface::UniformBlock,
    project::{PassName, Project},
};

/// A place in a picture, counted from the bottom left.
pub(crate) type Pixel = (u32, u32);

/// What a pass reads whose program asks for no uniform and no channel.
pub(crate) fn nothing_read(size: (u32, u32)) -> PassInputs {
    PassInputs {
        face: 0,
        uniforms: UniformBlock::zeroed(),
        custom_uniforms: Vec::new(),
        channels: std::array::from_fn(|_| TextureCopy::black()),
        size,
        meshes: Vec::new(),
    }
}

/// Walks through a pass for these pixels; `None` where one is discarded.
#[track_caller]
pub(crate) fn walk(project: &Project, id: &PassName, read: &PassInputs, pixels: &[Pixel]) -> Vec<Option<[f32; 4]>> {
    let index = project.passes.iter().position(|pass| pass.id == *id).expect("the pass");
    let extent = Extent { steps: 0, ..Extent::default() };
    let tracer = Tracer::new(&Sources::new(project), index, read, extent);
    let tracer = tracer.unwrap_or_else(|error| panic!("{}: {error}", id.title()));
    let value = |&pixel| tracer.trace(pixel).unwrap_or_else(|error| panic!("{pixel:?}: {error}")).value;
    pixels.iter().map(value).collect()
}

/// All places of a picture.
pub(crate) fn all_pixels((width, height): (u32, u32)) -> Vec<Pixel> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).collect()
}

/// The same number, of two zeros and two NaN too.
pub(crate) fn is_same(a: f32, b: f32) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

/// Walks through a pass of the newest frame for all of its pixels: every component must be what was drawn.
#[track_caller]
pub(crate) fn assert_walked(engine: &mut Engine, project: &Project, id: &PassName) {
    let (read, drawn) = (engine.inspect(id).unwrap(), engine.read(id).unwrap());
    let pixels = all_pixels(read.size);
    for (&pixel, value) in pixels.iter().zip(walk(project, id, &read, &pixels)) {
        let drawn = texel(&drawn, pixel.0, pixel.1);
        let value = value.expect("nothing is discarded");
        assert!(
            value.iter().zip(drawn).all(|(&a, b)| is_same(a, b)),
            "{} at {pixel:?}: walked {value:?}, drawn {drawn:?}",
            id.title()
        );
    }
}
