//! The text of an Image pass, as the front end takes it.

use eddy::{
    diag::SourceId,
    glsl::{ChannelKind, Driver, PassKind, PassSource, Text},
};

pub fn source(text: &str) -> PassSource<'_> {
    PassSource {
        kind: PassKind::Image,
        common: None,
        code: Text { id: SourceId(0), text },
        includes: &[],
        channels: [ChannelKind::Sampler2D; 4],
        knobs: &[],
        values: &[],
        bilinear_by_hand: [false; 4],
        driver: Driver::default(),
    }
}
