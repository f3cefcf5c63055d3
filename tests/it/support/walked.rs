//! The walker compared with a device.

use super::texel;
use bytemuck::Zeroable;
use eddy::{
    debugger::trace::{Extent, Tracer},
    engine::{Engine, PassInputs, Sources, TextureCopy},
    glsl::interface::UniformBlock,
    project::{PassName, Project},
};

/// A pixel of a picture, counted from the bottom left.
pub(crate) type Pixel = (u32, u32);

/// Returns the inputs of a pass whose program reads no uniform and no channel.
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

/// Walks a pass for these pixels; a discarded one is `None`.
#[track_caller]
pub(crate) fn walk(project: &Project, id: &PassName, read: &PassInputs, pixels: &[Pixel]) -> Vec<Option<[f32; 4]>> {
    let index = project.passes.iter().position(|pass| pass.id == *id).expect("the pass");
    let extent = Extent { steps: 0, ..Extent::default() };
    let tracer = Tracer::new(&Sources::new(project), index, read, extent);
    let tracer = tracer.unwrap_or_else(|error| panic!("{}: {error}", id.title()));
    let value = |&pixel| tracer.trace(pixel).unwrap_or_else(|error| panic!("{pixel:?}: {error}")).value;
    pixels.iter().map(value).collect()
}

/// Returns all pixels of a picture.
pub(crate) fn all_pixels((width, height): (u32, u32)) -> Vec<Pixel> {
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).collect()
}

/// Returns whether two numbers are equal. Zeros of both signs are equal, and so are all NaNs.
pub(crate) fn is_same(a: f32, b: f32) -> bool {
    a == b || a.is_nan() && b.is_nan()
}

/// Walks a pass of the newest frame for all of its pixels, and asserts that every component equals the drawn one.
#[track_caller]
pub(crate) fn assert_walked(engine: &mut Engine, project: &Project, id: &PassName) {
    let (read, drawn) = (engine.inspect(id).unwrap(), engine.read(id).unwrap());
    let pixels = all_pixels(read.size);
    for (&pixel, value) in pixels.iter().zip(walk(project, id, &read, &pixels)) {
        let drawn = texel(&drawn, pixel.0, pixel.1);
        let value = value.expect("no pixel is discarded");
        assert!(
            value.iter().zip(drawn).all(|(&a, b)| is_same(a, b)),
            "{} at {pixel:?}: walked {value:?}, drawn {drawn:?}",
            id.title()
        );
    }
}
