//! The versions of Mesa that have a fault, as far as they were tried.
//!
//! Debian's 22.3.6 and 26.2.6 were: `work_arounds_are_on_where_their_faults_are_seen` in `tests/it/glsl_loops.rs`, and
//! `extremes_ignore_nan` in `tests/it/glsl_drivers.rs`, tell what the driver at hand does without a work-around. A
//! version between the two has the work-around for a fault of either; a later one is treated like the later.

/// A version of Mesa, as 26, 2, 6.
pub(super) type Version = [u32; 3];

/// The versions that were tried.
const OLDER: Version = [22, 3, 6];
const NEWER: Version = [26, 2, 6];

/// Returns the version of Mesa in a driver's description, as "Mesa 22.3.6 (LLVM 15.0.6)" or "4.5 (Core Profile) Mesa
/// 26.3.0-devel (git-0123456789)". A version under development is that of the release. `None` if there is none.
pub(super) fn version(driver_info: &str) -> Option<Version> {
    let text = driver_info.split("Mesa ").nth(1)?;
    let end = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let mut parts = text[..end].split('.').map(|part| part.parse().ok());
    // The first number alone is enough; a part that is missing is 0.
    Some([parts.next()??, parts.next().flatten().unwrap_or(0), parts.next().flatten().unwrap_or(0)])
}

/// Returns whether loops keep values of pixels that have left them (`Gpu::keeps_loops_open`).
pub(super) fn keeps_loops_open(version: Option<Version>) -> bool {
    version.is_none_or(|version| version < NEWER)
}

/// Returns whether loops may end too early that count down to a minimum (`Gpu::misjudges_limits`).
pub(super) fn misjudges_limits(version: Option<Version>) -> bool {
    version.is_none_or(|version| version < NEWER)
}

/// Returns whether the minimum of a number and NaN may be NaN (`Gpu::nan_extremes`).
pub(super) fn has_nan_extremes(version: Option<Version>) -> bool {
    version.is_none_or(|version| version > OLDER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn versions_are_read_from_descriptions() {
        for (text, expected) in [
            ("Mesa 22.3.6 (LLVM 15.0.6)", Some([22, 3, 6])),
            ("Mesa 26.2.6-1 (LLVM 22.1.8)", Some([26, 2, 6])),
            ("4.5 (Core Profile) Mesa 26.3.0-devel (git-0123456789)", Some([26, 3, 0])),
            ("Mesa 27", Some([27, 0, 0])),
            ("Mesa 25.0.", Some([25, 0, 0])),
            ("Mesa git", None),
            ("580.76.05", None),
            ("SwiftShader driver 5.0.0", None),
            ("", None),
        ] {
            assert_eq!(version(text), expected, "{text}");
        }
    }

    #[test]
    fn work_arounds_end_with_the_versions_that_need_them() {
        let faults = |version| (keeps_loops_open(version), misjudges_limits(version), has_nan_extremes(version));
        assert_eq!(faults(Some([22, 3, 6])), (true, true, false));
        assert_eq!(faults(Some([9, 9, 9])), (true, true, false));
        // Not tried.
        assert_eq!(faults(Some([22, 3, 7])), (true, true, true));
        assert_eq!(faults(Some([26, 2, 5])), (true, true, true));
        assert_eq!(faults(Some([26, 2, 6])), (false, false, true));
        assert_eq!(faults(Some([26, 10, 0])), (false, false, true));
        assert_eq!(faults(None), (true, true, true));
    }
}
