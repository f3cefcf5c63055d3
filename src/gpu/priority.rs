//! The place of a thread among others, where a processor draws.

/// Lets other threads go before the calling one. On Linux this is a thread's own, and the threads that a driver starts
/// for it have it from it.
pub fn step_back(steps: i32) {
    #[cfg(target_os = "linux")]
    if let Err(error) = rustix::process::nice(steps) {
        log::debug!("a thread keeps its priority: {error}");
    }
    #[cfg(not(target_os = "linux"))]
    let _ = steps;
}
