//! The end of the process where a driver hangs.

/// Ends the process without the exit handlers of libraries where a thread was left behind in a call of the driver: its
/// handlers would wait for that thread, or free what it uses. Returns where there is none.
#[cfg(target_os = "linux")]
pub(super) fn end_process(code: u8) {
    use crate::{gpu::loss::OPENER, playback::offline::DRAWER};
    use std::{fs, io::Write};

    let names = fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let mut names = names.filter_map(|thread| fs::read_to_string(thread.path().join("comm")).ok());
    if !names.any(|name| [OPENER, DRAWER].contains(&name.trim_end())) {
        return;
    }
    let _ = std::io::stdout().flush();
    let _ = std::io::stderr().flush();
    // SAFETY: it takes any code, and touches no memory of the process.
    unsafe { libc::_exit(code.into()) }
}

#[cfg(not(target_os = "linux"))]
pub fn end_process(_: u8) {}
