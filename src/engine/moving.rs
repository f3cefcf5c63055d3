//! Textures of videos and cameras.

use super::{
    FrameInputs,
    external::{ChannelClock, ExternalTexture},
};
use eddy_texture::{TexelFormat, TextureShape};
use eddy_video::{Camera, CameraFrame, Frame, FrameSource, PLACEHOLDER, Pace};
use std::sync::Arc;

/// The frame of a looping video at `iTime`.
pub(super) struct VideoTexture {
    source: Arc<dyn FrameSource>,
    pace: Pace,
    shown: Picture,
    is_late: bool,
}

/// The texels of a frame, in the row order of the texture.
struct Picture {
    size: (u32, u32),
    vflip: bool,
    of: Option<Frame>,
    /// Opaque black before the first frame.
    bytes: Vec<u8>,
}

impl Picture {
    fn new(size: (u32, u32), vflip: bool) -> Self {
        Self { size, vflip, of: None, bytes: Vec::new() }
    }

    fn shape(&self) -> TextureShape {
        TextureShape::flat(self.size.0, self.size.1, TexelFormat::Rgba8)
    }

    /// Stores a frame of the right size. Returns whether it differs from the previous one, which the first always does.
    fn take(&mut self, frame: Option<Frame>) -> bool {
        let is_same = match (&self.of, &frame) {
            (Some(before), Some(frame)) => before.is(frame),
            (_, None) => true,
            (None, Some(_)) => false,
        };
        if is_same && !self.bytes.is_empty() {
            return false;
        }
        let row = self.size.0 as usize * 4;
        match &frame {
            None => self.bytes = [0, 0, 0, 255].repeat(self.size.0 as usize * self.size.1 as usize),
            // The top row is at v = 1: row 0 is the bottom.
            Some(frame) if self.vflip => {
                self.bytes.clear();
                frame.texels.rchunks_exact(row).for_each(|row| self.bytes.extend_from_slice(row));
            }
            Some(frame) => self.bytes.clone_from(&frame.texels),
        }
        self.of = frame;
        true
    }
}

impl VideoTexture {
    pub(crate) fn new(source: Arc<dyn FrameSource>, vflip: bool, pace: Pace) -> Self {
        let info = source.info();
        Self { source, pace, shown: Picture::new((info.width, info.height), vflip), is_late: false }
    }
}

impl ExternalTexture for VideoTexture {
    fn shape(&self) -> TextureShape {
        self.shown.shape()
    }

    fn advance(&mut self, inputs: &FrameInputs) -> bool {
        let shown = self.source.frame_at(inputs.time_secs, self.pace);
        self.is_late = shown.is_late;
        self.shown.take(shown.frame)
    }

    fn bytes(&self) -> &[u8] {
        &self.shown.bytes
    }

    fn is_late(&self) -> bool {
        self.is_late
    }

    fn clock(&self) -> ChannelClock {
        ChannelClock::Looped(self.source.info().seconds)
    }
}

/// The newest picture of a camera; black and of Shadertoy's size if no camera is on.
pub(super) struct Webcam {
    camera: Option<Camera>,
    shown: Picture,
}

impl Webcam {
    pub(crate) fn new(camera: Option<Camera>, vflip: bool) -> Self {
        let newest = camera.as_ref().and_then(Camera::newest);
        let size = newest.map_or(PLACEHOLDER, |newest| (newest.width, newest.height));
        Self { camera, shown: Picture::new(size, vflip) }
    }
}

impl ExternalTexture for Webcam {
    fn shape(&self) -> TextureShape {
        self.shown.shape()
    }

    fn advance(&mut self, _: &FrameInputs) -> bool {
        let newest = self.camera.as_ref().and_then(Camera::newest);
        // A camera that was switched on later belongs to the next program.
        let newest = newest.filter(|newest| (newest.width, newest.height) == self.shown.size);
        self.shown.take(newest.map(|newest| newest.frame))
    }

    fn camera_picture(&self) -> Option<CameraFrame> {
        let (width, height) = self.shown.size;
        self.shown.of.clone().map(|frame| CameraFrame { width, height, frame })
    }

    fn bytes(&self) -> &[u8] {
        &self.shown.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_flipped_and_uploaded_once() {
        let frame = |first: u8| Frame { texels: Arc::new((first..first + 8).collect()) };
        let (one, two) = (frame(0), frame(8));
        let mut upright = Picture::new((1, 2), true);
        assert!(upright.take(None), "black is written once");
        assert_eq!(upright.bytes, [0, 0, 0, 255, 0, 0, 0, 255]);
        assert!(!upright.take(None));
        assert!(upright.take(Some(one.clone())));
        assert_eq!(upright.bytes, [4, 5, 6, 7, 0, 1, 2, 3]);
        assert!(!upright.take(Some(one.clone())) && upright.take(Some(two)));
        let mut as_stored = Picture::new((1, 2), false);
        assert!(as_stored.take(Some(one)));
        assert_eq!(as_stored.bytes, [0, 1, 2, 3, 4, 5, 6, 7]);
    }
}
