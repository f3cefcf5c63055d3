//! Textures whose texels come from outside of the passes, and the table of what fills them.

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

/// A source of texels that is no pass.
pub(super) trait ExternalTexture: Send {
    /// Returns the shape of the texture, without mip levels.
    fn shape(&self) -> TextureShape;

    /// Takes the state of a frame. Returns whether the texels differ from those before.
    fn advance(&mut self, inputs: &FrameInputs) -> bool;

    /// Returns the texels as [`Texture::write`] takes them. They are zeros before the first call of
    /// [`ExternalTexture::advance`] that returns true.
    fn bytes(&self) -> &[u8];

    /// Returns whether the texels of the newest frame had to be left out, as they were not there in time: the frame is
    /// worth drawing again.
    fn is_late(&self) -> bool {
        false
    }

    /// Returns the picture of a camera that the newest frame shows.
    fn camera_picture(&self) -> Option<CameraFrame> {
        None
    }

    /// Says what `iChannelTime` is.
    fn clock(&self) -> ChannelClock {
        ChannelClock::Stopped
    }

    /// Returns texels that are the same in every frame: programs share their texture.
    fn constant(&self) -> Option<&Arc<Texels>> {
        None
    }
}

/// Returns what fills the texture of a channel; `None` for a pass and for what is not there.
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

/// Says what `iChannelTime` of a channel is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum ChannelClock {
    /// Zero.
    #[default]
    Stopped,
    /// The position in media that are played in a loop of so many seconds.
    Looped(f64),
    /// 10 s more than `iTime`, as the site has it for music that it may not play.
    Synthetic,
    /// Zero while there is a microphone, and as [`ChannelClock::Synthetic`] while there is none.
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

/// The spectrum and the wave of music that plays from `iTime` 0 on in a loop; without a file what the site makes up.
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
        // A frame that is drawn again while time stands still asks the analyser for nothing.
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

/// Returns the texture of a file that cannot be read: no level at any frequency, and a wave that rests.
fn silence() -> Texels {
    let bytes = [[0; BINS], [128; BINS]].concat();
    Texels::flat(BINS as u32, 2, TexelFormat::R8, bytes)
}

/// The spectrum and the wave of the microphone, which come with the frame; without one what the site makes up.
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

/// A decoded file, or one of Eddy's own textures.
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
    /// Channels that read the same share it.
    pub key: ExternalKey,
    source: Box<dyn ExternalTexture>,
    pub texture: Texture,
    /// The number of times that its texels have changed.
    pub version: u64,
    /// Makes the mip levels of texels that change.
    mips: Option<(MipMaker, MipChain)>,
}

/// Says which external texture it is: what is read, whether upside down, and whether with mip levels.
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
        let mips = has_chain.then(|| {
            let mut maker = MipMaker::new(gpu);
            let chain = maker.chain(gpu, &texture);
            (maker, chain)
        });
        Ok(Self { key, source, texture, version: 0, mips })
    }

    /// The texels, where they are the same in every frame.
    pub(crate) fn texels(&self) -> Option<&Arc<Texels>> {
        self.source.constant()
    }

    /// Returns whether the frame that is drawn shows other texels than it should: see [`ExternalTexture::is_late`].
    pub(crate) fn is_late(&self) -> bool {
        self.source.is_late()
    }

    /// Returns the picture of a camera that the frame shows: see [`ExternalTexture::camera_picture`].
    pub(crate) fn camera_picture(&self) -> Option<CameraFrame> {
        self.source.camera_picture()
    }

    /// Writes the texels of a frame if they are other than before.
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
