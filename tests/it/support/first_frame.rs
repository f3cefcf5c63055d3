//! The first frame of a program, in a separate process.

use super::skipped;
use std::{
    process::{Command, Stdio},
    time::{Duration, Instant},
};

/// Draws one frame in a separate process, without the driver's shader cache, and returns its picture's bytes.
pub(crate) fn first_frame(name: &str, text: &str, limit: Duration) -> Option<Vec<u8>> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("image.glsl"), text).unwrap();
    let out = folder.path().join("out.npy");
    let mut child = Command::new(env!("CARGO_BIN_EXE_eddy"))
        .args(["render", "--size", "32x18", "--frames", "1", "--out"])
        .args([&out, folder.path()])
        .env("MESA_SHADER_CACHE_DISABLE", "true")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        // CPU time, as the machine may be busy.
        if cpu_time_of(child.id()).unwrap_or_else(|| start.elapsed()) > limit {
            child.kill().unwrap();
            child.wait().unwrap();
            panic!("{name} takes more than {limit:?} until its first frame");
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    let output = child.wait_with_output().unwrap();
    if output.status.code() == Some(2) && std::env::var_os("EDDY_REQUIRE_GPU").is_none() {
        skipped(&format!("{name}: {}", String::from_utf8_lossy(&output.stderr).trim().replace('\n', " ")));
        return None;
    }
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(std::fs::read(out).unwrap())
}

/// Returns the CPU time of all threads of a process; `None` if the system does not report it (`proc(5)`: fields 14 and
/// 15 of `stat`, in hundredths of a second).
fn cpu_time_of(process: u32) -> Option<Duration> {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field).and_then(|text| text.parse::<u64>().ok());
    Some(Duration::from_millis(10 * (ticks(11)? + ticks(12)?)))
}
