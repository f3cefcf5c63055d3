//! Numbers that somebody gives a test by variables of the environment.

/// The number that a variable holds; `otherwise` where it is not set.
pub(crate) fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap_or_else(|e| panic!("{name}={text}: {e}")))
}
