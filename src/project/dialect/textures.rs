//! Textures that the program binds for which a text was written.

/// The meaning of a texture's name in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HostTexture {
    /// A picture of the user's, counted from 0.
    Picture(usize),
    /// The target of the pass that `BUFFER_n` selects.
    Buffer(usize),
    /// The target of the pass that `DOUBLE_BUFFER_n` selects, which reads its own previous frame.
    DoubleBuffer(usize),
    /// The picture before the pass that `POSTPROCESSING` selects.
    Scene,
    /// An output of the previous frame; output 0 is the picture.
    Previous(usize),
    /// The spectrum of a sound.
    Sound(SoundTexture),
}

/// The form in which a texture contains the spectrum of a sound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SoundTexture {
    Spectrum,
    /// Averaged over frames.
    Smoothed,
    /// Summed over frames.
    Integrated,
}
