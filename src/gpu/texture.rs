//! Textures with the views that a multipass renderer needs.

use super::{Gpu, GpuError};
use eddy_texture::{Dimension, TexelFormat, TextureShape};

/// The description of a texture to create.
#[derive(Clone, Copy, Debug)]
pub struct TextureDescriptor<'a> {
    pub label: &'a str,
    pub shape: TextureShape,
    /// Passes draw into it. Mips and readback require this too.
    pub is_target: bool,
}

/// A texture. Its texels start as zeros.
#[derive(Clone, Debug)]
pub struct Texture {
    pub raw: wgpu::Texture,
    pub shape: TextureShape,
    /// All levels and layers, for reading by shaders.
    pub all_levels: wgpu::TextureView,
    /// Level 0 of the first layer, for drawing by passes.
    pub level_0: wgpu::TextureView,
    /// Level 0 of the other faces of a cube.
    other_faces: Vec<wgpu::TextureView>,
}

/// Returns wgpu's name of a format.
pub fn texture_format(format: TexelFormat) -> wgpu::TextureFormat {
    use wgpu::TextureFormat as T;
    match format {
        TexelFormat::R8 => T::R8Unorm,
        TexelFormat::Rg8 => T::Rg8Unorm,
        TexelFormat::Rgba8 => T::Rgba8Unorm,
        TexelFormat::R16f => T::R16Float,
        TexelFormat::Rg16f => T::Rg16Float,
        TexelFormat::Rgba16f => T::Rgba16Float,
        TexelFormat::R32f => T::R32Float,
        TexelFormat::Rg32f => T::Rg32Float,
        TexelFormat::Rgba32f => T::Rgba32Float,
    }
}

/// Returns wgpu's view dimension for a whole texture.
pub fn view_dimension(dimension: Dimension) -> wgpu::TextureViewDimension {
    match dimension {
        Dimension::D2 => wgpu::TextureViewDimension::D2,
        Dimension::D3 => wgpu::TextureViewDimension::D3,
        Dimension::Cube => wgpu::TextureViewDimension::Cube,
    }
}

/// Returns the extent of level 0 with all layers.
fn extent(shape: TextureShape) -> wgpu::Extent3d {
    let TextureShape { width, height, depth, .. } = shape;
    wgpu::Extent3d { width, height, depth_or_array_layers: depth * shape.layers() }
}

/// Creates a view of one level of one layer.
fn level_view(
    texture: &wgpu::Texture,
    label: &str,
    dimension: Option<wgpu::TextureViewDimension>,
    (layer, level): (u32, u32),
) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        label: Some(label),
        dimension,
        base_mip_level: level,
        mip_level_count: Some(1),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

impl Texture {
    /// Creates a texture. Returns an error for a size that no target can have, and if memory is exhausted.
    pub fn new(gpu: &Gpu, descriptor: &TextureDescriptor<'_>) -> Result<Texture, GpuError> {
        let TextureDescriptor { label, shape, is_target } = *descriptor;
        gpu.check_shape(label, shape)?;
        let mut usage =
            wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC | wgpu::TextureUsages::COPY_DST;
        let is_volume = shape.dimension == Dimension::D3;
        if is_target || shape.levels > 1 && !is_volume {
            usage |= wgpu::TextureUsages::RENDER_ATTACHMENT;
        }
        let raw = gpu.guarded(label, || {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: extent(shape),
                mip_level_count: shape.levels,
                sample_count: 1,
                dimension: if is_volume { wgpu::TextureDimension::D3 } else { wgpu::TextureDimension::D2 },
                format: texture_format(shape.format),
                usage,
                view_formats: &[],
            })
        })?;
        let dimension = (!is_volume).then_some(wgpu::TextureViewDimension::D2);
        let level_0 = |layer| level_view(&raw, label, dimension, (layer, 0));
        let all_levels = raw.create_view(&wgpu::TextureViewDescriptor {
            label: Some(label),
            dimension: Some(view_dimension(shape.dimension)),
            ..Default::default()
        });
        let other_faces = (1..shape.layers()).map(level_0).collect();
        Ok(Texture { level_0: level_0(0), other_faces, all_levels, shape, raw })
    }

    /// Creates a view of a level of a layer, as a flat picture.
    pub(super) fn level(&self, label: &str, layer: u32, level: u32) -> wgpu::TextureView {
        level_view(&self.raw, label, Some(wgpu::TextureViewDimension::D2), (layer, level))
    }

    /// Returns level 0 of a layer.
    pub fn layer(&self, layer: u32) -> &wgpu::TextureView {
        match layer {
            0 => &self.level_0,
            face => &self.other_faces[face as usize - 1],
        }
    }

    /// Returns level 0 as an attachment that is stored.
    pub fn attachment(&self, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
        self.layer_attachment(0, load)
    }

    /// Does the same for a layer.
    pub fn layer_attachment(&self, layer: u32, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
        wgpu::RenderPassColorAttachment {
            view: self.layer(layer),
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        }
    }

    pub fn width(&self) -> u32 {
        self.shape.width
    }

    pub fn height(&self) -> u32 {
        self.shape.height
    }

    /// Writes level 0. `bytes` contains the rows of each layer or slice without padding, row 0 first.
    pub fn write(&self, gpu: &Gpu, bytes: &[u8]) {
        self.write_level(gpu, 0, bytes);
    }

    /// Writes a level in the same way.
    pub fn write_level(&self, gpu: &Gpu, level: u32, bytes: &[u8]) {
        let [width, height, depth] = self.shape.level(level);
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * self.shape.format.bytes() as u32),
            rows_per_image: Some(height),
        };
        let to = wgpu::TexelCopyTextureInfo { mip_level: level, ..self.raw.as_image_copy() };
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: depth * self.shape.layers() };
        gpu.queue.write_texture(to, bytes, layout, size);
    }

    /// Writes one texel of level 0. `bytes` contains one texel of the format.
    pub fn write_texel(&self, gpu: &Gpu, (x, y): (u32, u32), bytes: &[u8]) {
        let mut place = self.raw.as_image_copy();
        place.origin = wgpu::Origin3d { x, y, z: 0 };
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: None, rows_per_image: None };
        let one = wgpu::Extent3d { width: 1, height: 1, depth_or_array_layers: 1 };
        gpu.queue.write_texture(place, bytes, layout, one);
    }

    /// Copies the overlap of two textures of one format, texel for texel from row 0, column 0.
    pub fn copy_overlap(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, to: &Texture) {
        let (from, into) = (extent(self.shape), extent(to.shape));
        let size = wgpu::Extent3d {
            width: from.width.min(into.width),
            height: from.height.min(into.height),
            depth_or_array_layers: from.depth_or_array_layers.min(into.depth_or_array_layers),
        };
        let face = |layer| Some((layer, self.bound_face(gpu, layer, 0)?));
        let faces: Vec<_> = (0..self.shape.layers()).filter_map(face).collect();
        for (layer, face) in &faces {
            face.draw(gpu, encoder, to.layer(*layer), (size.width, size.height));
        }
        if faces.is_empty() {
            encoder.copy_texture_to_texture(self.raw.as_image_copy(), to.raw.as_image_copy(), size);
        }
    }

    /// Sets all texels of level 0 of every layer. The texture must be a target.
    pub fn clear(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, color: wgpu::Color) {
        for layer in 0..self.shape.layers() {
            gpu.pass(
                encoder,
                wgpu::RenderPassDescriptor {
                    label: Some("clear"),
                    color_attachments: &[Some(self.layer_attachment(layer, wgpu::LoadOp::Clear(color)))],
                    ..Default::default()
                },
                |_| (),
            );
        }
    }
}
