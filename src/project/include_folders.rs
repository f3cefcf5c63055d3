//! Folders of libraries, such as lygia, in which included files are found that the project's own folder lacks.

use std::{env, path::PathBuf};

/// The environment variable with these folders, separated as in `PATH`.
pub const INCLUDE_VARIABLE: &str = "EDDY_INCLUDE";

/// Returns the folders in the order in which they are searched.
pub(super) fn all() -> Vec<PathBuf> {
    env::var_os(INCLUDE_VARIABLE).map_or_else(Vec::new, |folders| env::split_paths(&folders).collect())
}
