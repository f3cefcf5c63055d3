//! The start of the process on Windows: the folders of its libraries, and its console.
//!
//! Eddy is a program of the console, so that a shell waits for a command, shows what it prints and gets its exit code. A
//! program of the other kind (`windows_subsystem`) has none of these, and a second executable for the window would have to be
//! kept beside this one. So a window that was started from the desktop gives its console back. Windows 11 24H2 opens none, as the
//! manifest asks (`consoleAllocationPolicy`); older ones show it for a moment.

#[cfg(any(windows, test))]
use std::{
    ffi::OsStr,
    path::{Path, PathBuf},
};

/// Chooses the folders that libraries are loaded from. The current one, which may be a stranger's project, is not among
/// them: wgpu loads `dxcompiler.dll`, the compiler of shaders for Direct3D 12, by its name alone. Call it before other threads
/// start.
pub(super) fn confine_libraries() {
    #[cfg(windows)]
    {
        use std::{env, os::windows::ffi::OsStrExt, ptr};
        use windows_sys::Win32::System::LibraryLoader::{
            LOAD_WITH_ALTERED_SEARCH_PATH, LoadLibraryExW, SetDllDirectoryW,
        };
        // SAFETY: the text is empty, and ends with 0. The call removes the current folder.
        if unsafe { SetDllDirectoryW([0].as_ptr()) } == 0 {
            log::warn!("libraries are also loaded from the current folder: {}", std::io::Error::last_os_error());
        }
        let is_loaded = env::current_exe().ok().is_some_and(|program| {
            let path = env::var_os("PATH").unwrap_or_default();
            let Some(library) = find_library(DXC, &program, &path) else { return false };
            let library: Vec<u16> = library.as_os_str().encode_wide().chain([0]).collect();
            // The library of this name that is loaded already is the one that wgpu gets.
            // SAFETY: the path ends with 0, and the library, which is never unloaded, is one that the user has installed.
            let module = unsafe { LoadLibraryExW(library.as_ptr(), ptr::null_mut(), LOAD_WITH_ALTERED_SEARCH_PATH) };
            !module.is_null()
        });
        if !is_loaded && env::var_os(COMPILER).is_none() {
            // wgpu does not look for the library then.
            // SAFETY: there are no other threads, and on Windows the environment has a lock.
            unsafe { env::set_var(COMPILER, "fxc") };
        }
    }
}

/// The library of DXC.
#[cfg(windows)]
const DXC: &str = "dxcompiler.dll";

/// The environment variable by which wgpu chooses the compiler of shaders for Direct3D 12.
#[cfg(windows)]
const COMPILER: &str = "WGPU_DX12_COMPILER";

/// Returns the path of a library that lies beside the program or in a folder of the search path. Folders of the search path
/// that are relative to the current one are ignored.
#[cfg(any(windows, test))]
fn find_library(name: &str, program: &Path, path: &OsStr) -> Option<PathBuf> {
    let beside = program.parent().map(Path::to_owned);
    let folders = beside.into_iter().chain(std::env::split_paths(path));
    folders.filter(|folder| folder.is_absolute()).map(|folder| folder.join(name)).find(|library| library.is_file())
}

/// Closes the console if no other process uses it: the system has opened it for this one, which opens a window. What is
/// redirected stays as it is.
pub(super) fn close_own_console() {
    #[cfg(windows)]
    {
        use std::ptr;
        use windows_sys::Win32::System::Console::{
            FreeConsole, GetConsoleMode, GetConsoleProcessList, GetStdHandle, STD_ERROR_HANDLE, STD_INPUT_HANDLE,
            STD_OUTPUT_HANDLE, SetStdHandle,
        };
        let mut ids = [0; 2];
        // SAFETY: the list has this length. If it is too short, the call only returns the number of processes.
        if unsafe { GetConsoleProcessList(ids.as_mut_ptr(), 2) } != 1 {
            return;
        }
        for stream in [STD_INPUT_HANDLE, STD_OUTPUT_HANDLE, STD_ERROR_HANDLE] {
            let mut mode = 0;
            // SAFETY: the handle need not be that of a console, and the mode is written to.
            let is_console = unsafe { GetConsoleMode(GetStdHandle(stream), &mut mode) } != 0;
            if is_console {
                // The handle will be closed, and its number may become that of a file. Writing to none is not an error.
                // SAFETY: the stream may be missing.
                unsafe { SetStdHandle(stream, ptr::null_mut()) };
            }
        }
        // SAFETY: the call has no arguments.
        unsafe { FreeConsole() };
    }
}

/// Reports why the window could not open or had to close, in a dialog if there is no stream for errors. Returns the exit
/// code.
pub fn window_trouble(why: &str) -> u8 {
    #[cfg(windows)]
    {
        use std::{os::windows::io::AsRawHandle, ptr};
        use windows_sys::Win32::UI::WindowsAndMessaging::{MB_ICONERROR, MB_OK, MessageBoxW};
        if std::io::stderr().as_raw_handle().is_null() {
            let [text, title] = [why, "Eddy"].map(|text| text.encode_utf16().chain([0]).collect::<Vec<_>>());
            // SAFETY: both texts end with 0, and there is no parent window.
            unsafe { MessageBoxW(ptr::null_mut(), text.as_ptr(), title.as_ptr(), MB_OK | MB_ICONERROR) };
        }
    }
    super::trouble(why)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{env, fs};

    #[test]
    fn libraries_are_found_beside_the_program_and_on_the_absolute_search_path() {
        let dir = tempfile::tempdir().unwrap();
        let [home, other] = ["home", "other"].map(|name| dir.path().join(name));
        [&home, &other].into_iter().for_each(|folder| fs::create_dir(folder).unwrap());
        let found = |path: &[&Path]| find_library("x.dll", &home.join("eddy"), &env::join_paths(path).unwrap());
        assert_eq!(found(&[&other]), None);
        fs::write(other.join("x.dll"), "").unwrap();
        assert_eq!(found(&[&dir.path().join("gone"), &other]), Some(other.join("x.dll")));
        assert_eq!(found(&[]), None, "it is on the path alone");
        fs::write(home.join("x.dll"), "").unwrap();
        assert_eq!(found(&[&other]), Some(home.join("x.dll")));
        // The tests' current folder is the package's.
        assert_eq!(find_library("Cargo.toml", Path::new("eddy"), OsStr::new(".")), None);
    }
}
