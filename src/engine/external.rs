//! Textures whose texels come from outside the passes, and the table of their sources.

use super::{
    FrameInputs,
    moving::{VideoTexture, Webcam},
    uploads::Uploads,
};
use eddy_audio::{Analyser, BINS, SAMPLE_RATE, Sound, Spectrum, synthetic};
use eddy_gpu::{Gpu, GpuError, MipChain, MipMaker, Texture, TextureDescriptor};
use eddy_media::{Gamepads, Keyboard, MediaKey, MediaSet, Texels};
use eddy_project::{Channel, Input, InputKind, Media};
use eddy_texture::{TexelFormat, TextureShape};
use eddy_video::CameraFrame;
use std::sync::Arc;

/// A source of texels that is not a pass.
pub(super) trait ExternalTexture: Send {
    /// Returns the shape of the texture, without mip levels.
    fn shape(&self) -> TextureShape;

    /// Updates to the inputs of a frame. Returns whether the texels have changed.
    fn advance(&mut self, inputs: &FrameInputs) -> bool;

    /// Returns the texels in the form that [`Texture::write`] takes. They are zeros before the first call of
    /// [`ExternalTexture::advance`] that returns true.
    fn bytes(&self) -> &[u8];

    /// Returns whether the texels of the newest frame are missing because they were not decoded in time: the frame is
    /// worth redrawing.
    fn is_late(&self) -> bool {
        false
    }

    /// Returns the camera picture in the newest frame.
    fn camera_picture(&self) -> Option<CameraFrame> {
        None
    }

    /// Returns the definition of its `iChannelTime`.
    fn clock(&self) -> ChannelClock {
        ChannelClock::Stopped
    }

    /// Returns texels that never change: programs share their texture.
    fn constant(&self) -> Option<&Arc<Texels>> {
        None
    }
}

/// Returns the source of a channel's texture; `None` for a pass and for missing media.
pub(super) fn of_channel(media: &MediaSet, channel: &Channel) -> Option<Box<dyn ExternalTexture>> {
    match channel.input.kind() {
        InputKind::Buffer | InputKind::CubemapPass => None,
        InputKind::Keyboard => Some(Box::new(Keyboard::default())),
        InputKind::Gamepad => Some(Box::new(Gamepads::default())),
        InputKind::Texture | InputKind::Cubemap | InputKind::Volume => {
            Some(Box::new(Picture(media.get(&MediaKey::of_channel(channel)?)?.clone())))
        }
        InputKind::Music => Some(match (channel.input.media()?, media.sound(channel.input.media()?)) {
            (_, Some(sound)) => Box::new(Music::new(Some(sound.clone()))),
            (Media::Site { .. } | Media::Builtin(_), None) => Box::new(Music::new(None)),
            (Media::File(_) | Media::Picked(_), None) => Box::new(Picture(Arc::new(silence()))),
        }),
        InputKind::Video => {
            let video = media.video(channel.input.media()?)?.clone();
            Some(Box::new(VideoTexture::new(video, channel.sampler.vflip, media.pace())))
        }
        InputKind::Webcam => Some(Box::new(Webcam::new(media.camera().cloned(), channel.sampler.vflip))),
        InputKind::Microphone => Some(Box::new(Microphone([0; 2 * BINS]))),
    }
}

impl ExternalTexture for Keyboard {
    fn shape(&self) -> TextureShape {
        Self::SHAPE
    }

    fn advance(&mut self, inputs: &FrameInputs) -> bool {
        let is_other = *self != inputs.keyboard;
        self.clone_from(&inputs.keyboard);
        is_other
    }

    fn bytes(&self) -> &[u8] {
        Self::bytes(self)
    }
}

impl ExternalTexture for Gamepads {
    fn shape(&self) -> TextureShape {
        Self::SHAPE
    }

    fn advance(&mut self, inputs: &FrameInputs) -> bool {
        let is_other = *self != inputs.gamepads;
        self.clone_from(&inputs.gamepads);
        is_other
    }

    fn bytes(&self) -> &[u8] {
        bytemuck::cast_slice(self.texels())
    }
}

/// The definition of a channel's `iChannelTime`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum ChannelClock {
    /// Zero.
    #[default]
    Stopped,
    /// The position in media that loop with this duration in seconds.
    Looped(f64),
    /// `iTime` plus 10 s, as on Shadertoy for music that it may not play.
    Synthetic,
    /// Zero while there is a microphone, and like [`ChannelClock::Synthetic`] while there is none.
    Microphone,
}

impl ChannelClock {
    pub(crate) fn at(self, inputs: &FrameInputs) -> f32 {
        let time_secs = inputs.time_secs;
        match self {
            ChannelClock::Stopped => 0.0,
            ChannelClock::Microphone if inputs.microphone.is_some() => 0.0,
            ChannelClock::Looped(seconds) => time_secs.rem_euclid(seconds) as f32,
            ChannelClock::Synthetic | ChannelClock::Microphone => (10.0 + time_secs) as f32,
        }
    }
}

/// The spectrum and the wave of looping music that starts at `iTime` 0; without a file, Shadertoy's synthetic ones.
struct Music {
    sound: Option<Arc<Sound>>,
    analyser: Analyser,
    texture: Spectrum,
    time_secs: Option<f64>,
}

impl Music {
    fn new(sound: Option<Arc<Sound>>) -> Self {
        Self { sound, analyser: Analyser::default(), texture: [0; 2 * BINS], time_secs: None }
    }
}

impl ExternalTexture for Music {
    fn shape(&self) -> TextureShape {
        TextureShape::flat(BINS as u32, 2, TexelFormat::R8)
    }

    fn advance(&mut self, inputs: &FrameInputs) -> bool {
        let FrameInputs { time_secs, time_delta_secs, .. } = *inputs;
        // A frame that is redrawn at the same time does not run the analyser.
        if self.time_secs.replace(time_secs) == Some(time_secs) {
            return false;
        }
        let step = f64::from(time_delta_secs).max(1e-4);
        let sample = |frames: u32| ((time_secs - f64::from(frames) * step) * f64::from(SAMPLE_RATE)).round() as i64;
        let texture = match &self.sound {
            Some(sound) => self.analyser.texture((0..).map(sample), |n| sound.looped(n)),
            None => synthetic(time_secs),
        };
        std::mem::replace(&mut self.texture, texture) != texture
    }

    fn bytes(&self) -> &[u8] {
        &self.texture
    }

    fn clock(&self) -> ChannelClock {
        self.sound.as_ref().map_or(ChannelClock::Synthetic, |sound| ChannelClock::Looped(sound.seconds()))
    }
}

/// Returns the texture of an unreadable file: a zero spectrum, and a flat wave.
fn silence() -> Texels {
    let bytes = [[0; BINS], [128; BINS]].concat();
    Texels::flat(BINS as u32, 2, TexelFormat::R8, bytes)
}

/// The spectrum and the wave of the microphone, which come with the frame; without one, Shadertoy's synthetic ones.
struct Microphone(Spectrum);

impl ExternalTexture for Microphone {
    fn shape(&self) -> TextureShape {
        TextureShape::flat(BINS as u32, 2, TexelFormat::R8)
    }

    fn advance(&mut self, inputs: &FrameInputs) -> bool {
        let texture = inputs.microphone.as_deref().copied().unwrap_or_else(|| synthetic(inputs.time_secs));
        std::mem::replace(&mut self.0, texture) != texture
    }

    fn bytes(&self) -> &[u8] {
        &self.0
    }

    fn clock(&self) -> ChannelClock {
        ChannelClock::Microphone
    }
}

/// A decoded file, or a built-in texture.
pub(super) struct Picture(pub Arc<Texels>);

impl ExternalTexture for Picture {
    fn shape(&self) -> TextureShape {
        self.0.shape
    }

    fn advance(&mut self, _: &FrameInputs) -> bool {
        false
    }

    fn bytes(&self) -> &[u8] {
        &self.0.bytes
    }

    fn constant(&self) -> Option<&Arc<Texels>> {
        Some(&self.0)
    }
}

/// An external texture of a program, on the device.
pub(super) struct External {
    /// Channels with the same input share it.
    pub key: ExternalKey,
    source: Box<dyn ExternalTexture>,
    pub texture: Texture,
    /// The number of times its texels have changed.
    pub version: u64,
    /// Generates the mip levels of changing texels.
    mips: Option<(MipMaker, MipChain)>,
}

/// The identity of an external texture: its input, whether it is flipped, and whether it has mip levels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExternalKey {
    pub input: Input,
    pub vflip: bool,
    pub mips: bool,
}

impl External {
    pub(crate) fn new(
        gpu: &Gpu,
        uploads: &mut Uploads,
        key: ExternalKey,
        source: Box<dyn ExternalTexture>,
    ) -> Result<Self, GpuError> {
        let texture = match source.constant() {
            Some(texels) => uploads.picture(gpu, texels, key.mips)?,
            None => {
                let label = key.input.row().title;
                let shape = if key.mips { source.shape().with_mips() } else { source.shape() };
                Texture::new(gpu, &TextureDescriptor { label, shape, is_target: false })?
            }
        };
        let has_chain = source.constant().is_none() && texture.shape.levels > 1;
        let mips = match has_chain.then(|| MipMaker::new(gpu)) {
            Some(mut maker) => {
                let chain = maker.chain(gpu, &texture)?;
                Some((maker, chain))
            }
            None => None,
        };
        Ok(Self { key, source, texture, version: 0, mips })
    }

    /// The texels, if they never change.
    pub(crate) fn texels(&self) -> Option<&Arc<Texels>> {
        self.source.constant()
    }

    /// Returns whether the drawn frame has outdated texels: see [`ExternalTexture::is_late`].
    pub(crate) fn is_late(&self) -> bool {
        self.source.is_late()
    }

    /// Returns the camera picture in the frame: see [`ExternalTexture::camera_picture`].
    pub(crate) fn camera_picture(&self) -> Option<CameraFrame> {
        self.source.camera_picture()
    }

    /// Writes the texels of a frame if they have changed.
    pub(crate) fn update(&mut self, gpu: &Gpu, inputs: &FrameInputs) {
        if self.source.advance(inputs) {
            self.texture.write(gpu, self.source.bytes());
            if let Some((maker, chain)) = &self.mips {
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                maker.build(gpu, &mut encoder, chain);
                gpu.queue.submit([encoder.finish()]);
            }
            self.version += 1;
        }
    }
}
