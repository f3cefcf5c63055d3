//! Numbers that configure tests by environment variables.

/// Returns the number in a variable; `otherwise` if it is not set.
pub(crate) fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).map_or(otherwise, |text| text.parse().unwrap_or_else(|e| panic!("{name}={text}: {e}")))
}
