//! Shows targets in detail: pictures of their values, and single texels.

use super::Picture;
use eddy_gpu::{Gpu, GpuError, Presenter, Readback, TexelPicker, Texture, ValueLook, ValuePainter};

/// Paints into its own texture, so that the picture in the window is unaffected.
pub(super) struct Viewer {
    painter: ValuePainter,
    picker: TexelPicker,
    texture: Option<Texture>,
    readback: Readback,
}

impl Viewer {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        Self {
            painter: ValuePainter::new(gpu),
            picker: TexelPicker::new(gpu),
            texture: None,
            readback: Readback::default(),
        }
    }

    /// Returns a picture of a layer of a texture, of the same size.
    pub(crate) fn paint(
        &mut self,
        gpu: &Gpu,
        values: &Texture,
        layer: u32,
        look: &ValueLook,
    ) -> Result<Picture, GpuError> {
        let (width, height) = (values.width(), values.height());
        let has_size = |texture: &Texture| (texture.width(), texture.height()) == (width, height);
        let texture = match self.texture.take().filter(has_size) {
            Some(texture) => texture,
            None => Presenter::texture(gpu, width, height)?,
        };
        let texture = self.texture.insert(texture);
        self.painter.set(gpu, look);
        let bound = self.painter.bind(gpu, &values.readable(gpu, layer, 0)?);
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("picture of values") };
        let mut encoder = gpu.device.create_command_encoder(&descriptor);
        self.painter.present(gpu, &mut encoder, &bound, texture);
        gpu.queue.submit([encoder.finish()]);
        Ok(Picture { width, height, bytes: self.readback.rgba8(gpu, texture)? })
    }

    /// Returns the texel of each picture at a position from 0 to 1 across and up.
    pub(crate) fn texels(
        &mut self,
        gpu: &Gpu,
        views: &[wgpu::TextureView],
        at: [f32; 2],
    ) -> Result<Vec<[f32; 4]>, GpuError> {
        self.picker.pick(gpu, views, at)
    }
}
