//! What the front end makes of a text, without a device.

use eddy::glsl::{self, Compiled, Driver, PassSource};

/// The module of an Image pass without settings, for this driver.
pub(crate) fn compiled(code: &str, driver: Driver) -> Compiled {
    glsl::compile(&PassSource { driver, ..PassSource::image(code) }).unwrap_or_else(|errors| panic!("{errors:?}"))
}
