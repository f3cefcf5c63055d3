//! Textures whose texels come from outside of the passes, and the table of what fills them.

use super::{FrameInputs, uploads::Uploads};
use eddy_gpu::{Gpu, GpuError, Texture, TextureDescriptor};
use eddy_media::{Keyboard, MediaKey, MediaSet, Texels};
use eddy_project::{Channel, Input, InputKind};
use eddy_texture::TextureShape;
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

    /// Returns texels that are the same in every frame: programs share their texture.
    fn constant(&self) -> Option<&Arc<Texels>> {
        None
    }
}

/// Returns what fills the texture of a channel; `None` for a pass, for what is not there, and for kinds of inputs that
/// are not drawn yet.
pub(super) fn of_channel(media: &MediaSet, channel: &Channel) -> Option<Box<dyn ExternalTexture>> {
    match channel.input.kind() {
        InputKind::Buffer | InputKind::CubemapPass => None,
        InputKind::Keyboard => Some(Box::new(Keyboard::default())),
        InputKind::Texture | InputKind::Cubemap | InputKind::Volume => {
            Some(Box::new(Picture(media.get(&MediaKey::of_channel(channel)?)?.clone())))
        }
        InputKind::Video | InputKind::Music | InputKind::Microphone | InputKind::Webcam => None,
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
}

/// Says which external texture it is: what is read, whether upside down, and whether with mip levels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ExternalKey {
    pub input: Input,
    pub vflip: bool,
    pub mips: bool,
}

impl External {
    pub fn new(
        gpu: &Gpu,
        uploads: &mut Uploads,
        key: ExternalKey,
        source: Box<dyn ExternalTexture>,
    ) -> Result<Self, GpuError> {
        let texture = match source.constant() {
            Some(texels) => uploads.picture(gpu, texels, key.mips)?,
            None => {
                let label = key.input.row().title;
                Texture::new(gpu, &TextureDescriptor { label, shape: source.shape(), is_target: false })?
            }
        };
        Ok(Self { key, source, texture, version: 0 })
    }

    /// The texels, where they are the same in every frame.
    pub fn texels(&self) -> Option<&Arc<Texels>> {
        self.source.constant()
    }

    /// Writes the texels of a frame if they are other than before.
    pub fn update(&mut self, gpu: &Gpu, inputs: &FrameInputs) {
        if self.source.advance(inputs) {
            self.texture.write(gpu, self.source.bytes());
            self.version += 1;
        }
    }
}
