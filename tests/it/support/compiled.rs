//! What the front end makes of a text, without a device.

use eddy::{
    diag::SourceId,
    glsl::{self, ChannelKind, Compiled, Driver, PassKind, PassSource, Text},
};

/// The module of an Image pass without settings, for this driver.
pub fn compiled(code: &str, driver: Driver) -> Compiled {
    let source = PassSource {
        kind: PassKind::Image,
        common: None,
        code: Text { id: SourceId(0), text: code },
        includes: &[],
        channels: [ChannelKind::Sampler2D; 4],
        knobs: &[],
        values: &[],
        bilinear_by_hand: [false; 4],
        driver,
    };
    glsl::compile(&source).unwrap_or_else(|errors| panic!("{errors:?}"))
}
