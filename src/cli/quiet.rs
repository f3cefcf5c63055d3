//! Silences graphics libraries that complain about an unused window system.

/// Keeps Mesa from looking for a Wayland server if there cannot be one.
///
/// Its Vulkan layer `VK_LAYER_MESA_device_select` asks the server which device it draws with whenever devices are
/// listed, and libwayland, without `XDG_RUNTIME_DIR`, then writes "XDG_RUNTIME_DIR is invalid or not set" to standard
/// error, once for each of the two times that wgpu lists them. An absolute `WAYLAND_DISPLAY` does not need this folder,
/// and if no server listens at that path, it is silently ignored. The C library reads the environment, which a program
/// can safely change only for a process that it starts: so this function re-executes the program before doing anything
/// else. If that fails, the lines are written.
#[cfg(target_os = "linux")]
pub(super) fn ask_for_no_wayland() {
    use std::{env, os::unix::process::CommandExt, path::Path, process::Command};
    let is_absolute = |name: &str| env::var_os(name).is_some_and(|value| Path::new(&value).is_absolute());
    if is_absolute("XDG_RUNTIME_DIR") || is_absolute("WAYLAND_DISPLAY") {
        return;
    }
    let Ok(program) = env::current_exe() else { return };
    let mut arguments = env::args_os();
    let mut command = Command::new(program);
    if let Some(name) = arguments.next() {
        command.arg0(name);
    }
    let failed = command.args(arguments).env("WAYLAND_DISPLAY", "/dev/null").exec();
    log::debug!("cannot restart: {failed}");
}

#[cfg(not(target_os = "linux"))]
pub(super) fn ask_for_no_wayland() {}
