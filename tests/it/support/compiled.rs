//! Compiles a text without a device.

use eddy::glsl::{self, Compiled, Driver, PassSource};

/// Compiles an Image pass without settings for this driver.
pub(crate) fn compiled(code: &str, driver: Driver) -> Compiled {
    glsl::compile(&PassSource { driver, ..PassSource::image(code) }).unwrap_or_else(|errors| panic!("{errors:?}"))
}
