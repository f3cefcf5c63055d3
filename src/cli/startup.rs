//! The start of the process on Windows: the folders of its libraries, and its console.
//!
//! Eddy is a program of the console, so that a shell waits for a command, shows what it prints and gets its exit code. A
//! program of the other kind (`windows_subsystem`) has none of these, and a second executable for the window would have to be
//! kept beside this one. So a window that was started from the desktop gives its console back. Windows 11 24H2 opens none, as the
//! manifest asks (`consoleAllocationPolicy`); older ones show it for a moment.

/// Removes the current folder from those that libraries are loaded from: it may be a stranger's project, with a
/// `dxcompiler.dll`.
pub(super) fn confine_libraries() {
    #[cfg(windows)]
    {
        use windows_sys::Win32::System::LibraryLoader::SetDllDirectoryW;
        // SAFETY: the text is empty, and ends with 0.
        if unsafe { SetDllDirectoryW([0].as_ptr()) } == 0 {
            log::warn!("libraries are also loaded from the current folder: {}", std::io::Error::last_os_error());
        }
    }
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

/// Reports why the window could not open or had to close, in a dialog if nobody reads what is printed. Returns the exit
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
