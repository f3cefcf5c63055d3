//! The textures that the channels of a pass are bound to, and the way they are read on a device.

use super::{
    program::{BoundChannel, FilterMode},
    sources::dimension,
    uploads::Uploads,
};
use eddy_glsl::{ChannelUse, interface};
use eddy_gpu::{Binding, Gpu, GpuError};
use eddy_graph::{Draw, Source, effective_sampler};
use eddy_media::{MediaKey, MediaSet, Texels};
use eddy_project::{Channel, Filter, Input, PassId, PassSettings, Project};
use std::sync::Arc;

/// Returns how each channel of `project.passes[pass]` mixes texels on a device: the one place that decides it.
pub(super) fn filter_mode(gpu: &Gpu, project: &Project, media: &MediaSet, pass: usize) -> [FilterMode; 4] {
    std::array::from_fn(|index| {
        let Some(sampler) = effective_sampler(project, pass, index) else { return FilterMode::Nearest };
        let channel = project.passes[pass].channels[index].as_ref();
        let is_float = channel.and_then(|c| settings_of(project, c)).is_some_and(|s| s.format.is_32_bit())
            || channel.and_then(|c| picture(media, c)).is_some_and(|t| t.shape.format.is_32_bit());
        mixing_of(gpu, sampler.filter, is_float)
    })
}

/// Returns how the picture of a fill is mixed.
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
}

impl ChannelBinder<'_> {
    /// Returns one channel of a pass, whose picture is on the device if the program reads it.
    pub fn bind(
        &self,
        uploads: &mut Uploads,
        channel: Option<&Channel>,
        used: ChannelUse,
        filter_mode: FilterMode,
        mips: bool,
    ) -> Result<BoundChannel, GpuError> {
        let texels = channel.and_then(|c| picture(self.media, c));
        let is_used = used.texture || used.sampler;
        Ok(BoundChannel {
            dimension: dimension(channel),
            texture: used.texture,
            sampler: used.sampler,
            filter_mode,
            media: match texels.filter(|_| is_used) {
                Some(texels) => Some(uploads.picture(self.gpu, texels, mips)?),
                None => None,
            },
            resolution: match channel.map(|c| &c.input) {
                Some(Input::Keyboard) => [256.0, 3.0, 1.0],
                _ => texels.map_or([0.0; 3], |t| resolution(t)),
            },
            buffer: channel.and_then(|c| settings_of(self.project, c)).map(|s| s.size),
        })
    }

    /// Returns the one channel of a fill that is a picture.
    pub fn bind_fill(
        &self,
        uploads: &mut Uploads,
        texels: &Arc<Texels>,
        used: ChannelUse,
    ) -> Result<BoundChannel, GpuError> {
        Ok(BoundChannel {
            texture: used.texture,
            sampler: used.sampler,
            filter_mode: filter_mode_of_fill(self.gpu, texels),
            resolution: resolution(texels),
            media: Some(uploads.picture(self.gpu, texels, false)?),
            ..BoundChannel::default()
        })
    }
}

fn resolution(texels: &Texels) -> [f32; 3] {
    [texels.shape.width as f32, texels.shape.height as f32, 1.0]
}

/// Returns the picture that a channel names, if it names one and it is there.
fn picture<'m>(media: &'m MediaSet, channel: &Channel) -> Option<&'m Arc<Texels>> {
    match &channel.input {
        Input::Texture(of) => media.get(&MediaKey { media: of.clone(), vflip: channel.sampler.vflip }),
        _ => None,
    }
}

/// Returns the settings of the buffer that the channel names, if it names one; the format is that of the target.
fn settings_of(project: &Project, channel: &Channel) -> Option<PassSettings> {
    let (name, index) = channel.input.buffer()?;
    let mut settings = project.pass(&PassId::Buffer(name.to_owned())).map(|p| p.settings.clone()).unwrap_or_default();
    settings.format = settings.formats().get(index).copied().unwrap_or_default();
    Some(settings)
}

/// Returns the bind group that the channels of a draw are laid out in.
pub(super) fn channel_bindings(channels: &[BoundChannel; 4], draw: &Draw) -> Vec<(u32, Binding)> {
    let mut bindings = Vec::new();
    for (index, channel) in channels.iter().enumerate() {
        let dimension = eddy_gpu::view_dimension(channel.dimension);
        // An empty channel is an 8-bit texture and can always be filtered; it is bound like the others to need no third
        // case.
        let is_keyboard = matches!(draw.reads[index].as_ref().map(|r| &r.source), Some(Source::Keyboard));
        let filterable = channel.filter_mode == FilterMode::Sampler && !is_keyboard;
        if channel.texture {
            bindings.push((interface::texture_binding(index), Binding::Texture { dimension, filterable }));
        }
        if channel.sampler {
            bindings.push((interface::sampler_binding(index), Binding::Sampler { filtering: filterable }));
        }
    }
    bindings
}
