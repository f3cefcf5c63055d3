//! The textures that the channels of a pass are bound to, and how they are filtered on a device.

use super::{
    external::{self, ChannelClock, External, ExternalKey, ExternalTexture, Picture},
    program::{BoundChannel, BoundExternal, FilterMode},
    uploads::Uploads,
};
use eddy_diag::Diagnostic;
use eddy_glsl::{ChannelUse, MAX_CHANNELS, interface};
use eddy_gpu::{Binding, Gpu, GpuError};
use eddy_graph::effective_sampler;
use eddy_media::{MediaKey, MediaSet, Texels};
use eddy_project::{Channel, Filter, Input, Media, Pass, PassSize, Project};
use eddy_texture::{Dimension, TexelFormat, TextureShape};
use std::{path::Path, sync::Arc};

/// Returns the filtering of each channel of `project.passes[pass]` on a device: the one place that decides it.
pub(super) fn filter_mode(gpu: &Gpu, project: &Project, media: &MediaSet, pass: usize) -> [FilterMode; MAX_CHANNELS] {
    std::array::from_fn(|index| {
        let Some(sampler) = effective_sampler(project, pass, index) else { return FilterMode::Nearest };
        let channel = project.passes[pass].bindings.get(index);
        let drawn = channel.and_then(|c| target_of(project, c)).map(|(_, format)| format);
        let format = drawn.or_else(|| Some(external::of_channel(media, channel?)?.shape().format));
        mixing_of(gpu, sampler.filter, format.is_some_and(TexelFormat::is_32_bit))
    })
}

/// Returns the filtering of a fill's picture.
pub(super) fn filter_mode_of_fill(gpu: &Gpu, texels: &Texels) -> FilterMode {
    mixing_of(gpu, Filter::Linear, texels.shape.format.is_32_bit())
}

fn mixing_of(gpu: &Gpu, filter: Filter, is_float: bool) -> FilterMode {
    match filter {
        Filter::Nearest => FilterMode::Nearest,
        Filter::Linear | Filter::Mipmap if is_float && !gpu.filters_float32 => FilterMode::Shader,
        Filter::Linear | Filter::Mipmap => FilterMode::Sampler,
    }
}

/// Binds the channels of passes.
pub(super) struct ChannelBinder<'a> {
    pub gpu: &'a Gpu,
    pub project: &'a Project,
    pub media: &'a MediaSet,
    pub uploads: &'a mut Uploads,
    /// The external textures of the channels so far.
    pub externals: Vec<External>,
}

impl ChannelBinder<'_> {
    /// Returns one channel of a pass, whose texture is uploaded if the program reads it. A texture whose dimension
    /// differs from the channel's declaration cannot be read.
    pub(crate) fn bind(
        &mut self,
        (channel, dimension): (Option<&Channel>, Dimension),
        used: ChannelUse,
        filter_mode: FilterMode,
        mips: bool,
    ) -> Result<BoundChannel, GpuError> {
        let source = channel.and_then(|c| Some((c, source_on(self.gpu, self.media, c)?)));
        let resolution = source.as_ref().map_or([0.0; 3], |(_, source)| resolution(source.shape()));
        let clock = source.as_ref().map_or(ChannelClock::Stopped, |(_, source)| source.clock());
        let is_readable = |shape: TextureShape| (used.texture || used.sampler) && shape.dimension == dimension;
        let external = match source.filter(|(_, source)| is_readable(source.shape())) {
            Some((Channel { input, sampler }, source)) => {
                let key = ExternalKey { input: input.clone(), vflip: sampler.vflip, mips };
                Some(self.external(key, source)?)
            }
            None => None,
        };
        Ok(BoundChannel {
            dimension,
            texture: used.texture,
            sampler: used.sampler,
            filter_mode,
            external,
            resolution,
            clock,
            buffer: channel.and_then(|c| target_of(self.project, c)).map(|(size, _)| size),
        })
    }

    /// Returns the one channel of a fill that reads the picture of a file.
    pub(crate) fn bind_fill(
        &mut self,
        path: &Path,
        texels: &Arc<Texels>,
        used: ChannelUse,
    ) -> Result<BoundChannel, GpuError> {
        let MediaKey { media, vflip, .. } = MediaKey::of_fill(path);
        let key = ExternalKey { input: Input::texture(media), vflip, mips: false };
        Ok(BoundChannel {
            texture: used.texture,
            sampler: used.sampler,
            filter_mode: filter_mode_of_fill(self.gpu, texels),
            resolution: resolution(texels.shape),
            external: Some(self.external(key, Box::new(Picture(texels.clone())))?),
            ..BoundChannel::default()
        })
    }

    /// Returns the external texture of a key, created if necessary.
    fn external(&mut self, key: ExternalKey, source: Box<dyn ExternalTexture>) -> Result<BoundExternal, GpuError> {
        let index = match self.externals.iter().position(|made| made.key == key) {
            Some(index) => index,
            None => {
                self.externals.push(External::new(self.gpu, self.uploads, key, source)?);
                self.externals.len() - 1
            }
        };
        Ok(BoundExternal { index, texture: self.externals[index].texture.clone() })
    }
}

/// Returns the source of a channel's texture, unless it is larger than the textures of the device: then the channel reads
/// as an unloaded one, and [`size_warnings`] says so.
fn source_on(gpu: &Gpu, media: &MediaSet, channel: &Channel) -> Option<Box<dyn ExternalTexture>> {
    external::of_channel(media, channel).filter(|source| gpu.check_shape("", source.shape()).is_ok())
}

/// Returns a warning for each channel of a pass whose picture, volume or video is larger than the textures of the
/// device.
pub(super) fn size_warnings(gpu: &Gpu, media: &MediaSet, pass: &Pass) -> Vec<Diagnostic> {
    let warning = |(slot, channel): (usize, &Channel)| {
        let shape = external::of_channel(media, channel)?.shape();
        let name = match channel.input.media() {
            Some(Media::File(path) | Media::Picked(path)) => path.display().to_string(),
            Some(Media::Builtin(name)) => name.clone(),
            Some(Media::Site { path, .. }) => path.clone(),
            None => channel.input.row().title.to_owned(),
        };
        let what = format!("channel {slot} of {} is black: {name}", pass.id.title());
        let error = gpu.check_shape(&what, shape).err()?;
        Some(Diagnostic::warning(None, error.to_string()).hint("scale it down, or open the project on another device"))
    };
    pass.bindings.iter().filter_map(warning).collect()
}

/// Returns the channel's `iChannelResolution`. Shadertoy leaves that of a cubemap's files at zero.
fn resolution(shape: TextureShape) -> [f32; 3] {
    match shape.dimension {
        Dimension::Cube => [0.0; 3],
        Dimension::D2 | Dimension::D3 => [shape.width, shape.height, shape.depth].map(|side| side as f32),
    }
}

/// Returns the size and the format of the target that the channel names, if it names one.
fn target_of(project: &Project, channel: &Channel) -> Option<(PassSize, TexelFormat)> {
    let (id, index) = channel.input.target()?;
    if id.has_faces() {
        project.pass(id)?;
    }
    let pass = project.pass_or_empty(id);
    let format = pass.formats().get(index).copied().unwrap_or_default();
    Some((pass.size(), format))
}

/// Returns the bind group layout of a draw's channels.
pub(super) fn channel_bindings(channels: &[BoundChannel; MAX_CHANNELS]) -> Vec<(u32, Binding)> {
    let mut bindings = Vec::new();
    for (index, channel) in channels.iter().enumerate() {
        let dimension = eddy_gpu::view_dimension(channel.dimension);
        // An empty channel is an 8-bit texture and can always be filtered; it is bound like the others to avoid a third
        // case.
        let filterable = channel.filter_mode == FilterMode::Sampler;
        if channel.texture {
            bindings.push((interface::texture_binding(index), Binding::Texture { dimension, filterable }));
        }
        if channel.sampler {
            bindings.push((interface::sampler_binding(index), Binding::Sampler { filtering: filterable }));
        }
    }
    bindings
}
