//! Ends the process if a driver hangs.

/// Ends the process without the exit handlers of libraries if a thread is stuck in a call of the driver: the handlers
/// would wait for that thread, or free memory that it uses. Returns if there is no such thread.
#[cfg(any(target_os = "linux", windows))]
pub(super) fn end_process(code: u8) {
    use crate::{gpu::loss::OPEN_THREAD_NAME, playback::offline::DRAWER};
    use std::io::Write;

    if !thread_names().iter().any(|name| [OPEN_THREAD_NAME, DRAWER].contains(&name.as_str())) {
        return;
    }
    let _ = std::io::stdout().flush();
    let _ = std::io::stderr().flush();
    end_at_once(code);
}

#[cfg(not(any(target_os = "linux", windows)))]
pub(super) fn end_process(_: u8) {}

#[cfg(target_os = "linux")]
fn end_at_once(code: u8) -> ! {
    // SAFETY: `_exit` accepts any code, and accesses no memory of the process.
    unsafe { libc::_exit(code.into()) }
}

/// Ends the process. `ExitProcess`, which ends it otherwise, ends its threads wherever they are, and then calls the
/// handlers of its libraries, which may wait for a lock that such a thread holds.
#[cfg(windows)]
fn end_at_once(code: u8) {
    use windows_sys::Win32::System::Threading::{GetCurrentProcess, TerminateProcess};
    // SAFETY: the pseudo handle of this process is always valid.
    unsafe { TerminateProcess(GetCurrentProcess(), code.into()) };
}

/// Returns the names of the threads of this process.
#[cfg(target_os = "linux")]
fn thread_names() -> Vec<String> {
    use std::fs;
    let threads = fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let names = threads.filter_map(|thread| fs::read_to_string(thread.path().join("comm")).ok());
    names.map(|name| name.trim_end().to_owned()).collect()
}

/// Returns the names of the threads of this process.
#[cfg(windows)]
fn thread_names() -> Vec<String> {
    use std::os::windows::io::{AsRawHandle, FromRawHandle, OwnedHandle};
    use windows_sys::Win32::{
        Foundation::INVALID_HANDLE_VALUE,
        System::Diagnostics::ToolHelp::{
            CreateToolhelp32Snapshot, TH32CS_SNAPTHREAD, THREADENTRY32, Thread32First, Thread32Next,
        },
    };
    let mut names = Vec::new();
    // SAFETY: the call has no arguments that could be invalid.
    let snapshot = unsafe { CreateToolhelp32Snapshot(TH32CS_SNAPTHREAD, 0) };
    if snapshot == INVALID_HANDLE_VALUE {
        return names;
    }
    // SAFETY: the handle is open, and this value owns it.
    let snapshot = unsafe { OwnedHandle::from_raw_handle(snapshot) };
    let mut entry = THREADENTRY32 { dwSize: size_of::<THREADENTRY32>() as u32, ..THREADENTRY32::default() };
    // SAFETY: the snapshot is open, and the entry has the size that it says.
    let mut is_there = unsafe { Thread32First(snapshot.as_raw_handle(), &mut entry) } != 0;
    while is_there {
        // A snapshot has the threads of all processes.
        if entry.th32OwnerProcessID == std::process::id() {
            names.extend(thread_name(entry.th32ThreadID));
        }
        // SAFETY: as above.
        is_there = unsafe { Thread32Next(snapshot.as_raw_handle(), &mut entry) } != 0;
    }
    names
}

/// Returns the name of a thread; `None` if it has ended.
#[cfg(windows)]
fn thread_name(id: u32) -> Option<String> {
    use std::os::windows::io::{AsRawHandle, FromRawHandle, OwnedHandle};
    use windows_sys::Win32::{
        Foundation::LocalFree,
        System::Threading::{GetThreadDescription, OpenThread, THREAD_QUERY_LIMITED_INFORMATION},
    };
    // SAFETY: the id need not be that of a thread.
    let thread = unsafe { OpenThread(THREAD_QUERY_LIMITED_INFORMATION, 0, id) };
    if thread.is_null() {
        return None;
    }
    // SAFETY: the handle is open, and this value owns it.
    let thread = unsafe { OwnedHandle::from_raw_handle(thread) };
    let mut text = std::ptr::null_mut();
    // SAFETY: the handle is open, and the pointer is written to.
    let result = unsafe { GetThreadDescription(thread.as_raw_handle(), &mut text) };
    if result < 0 || text.is_null() {
        return None;
    }
    // SAFETY: a successful call returns a text that ends with 0.
    let length = (0..).take_while(|at| unsafe { *text.add(*at) } != 0).count();
    // SAFETY: all of these words were read.
    let name = String::from_utf16_lossy(unsafe { std::slice::from_raw_parts(text, length) });
    // SAFETY: the text was allocated for the caller, who frees it once.
    unsafe { LocalFree(text.cast()) };
    Some(name)
}

#[cfg(all(test, any(target_os = "linux", windows)))]
mod tests {
    use super::*;
    use crate::background::{Background, Control};
    use std::{
        sync::{Arc, mpsc},
        thread,
    };

    #[test]
    fn threads_are_found_by_their_names_while_they_run() {
        let (end, wait) = mpsc::channel::<()>();
        let waiting = move |_: &Control<()>| wait.recv().map_err(|e| e.to_string());
        let job = Background::once("leave-test", "waiting", Arc::new(|| ()), waiting).expect("a thread starts");
        let is_there = || thread_names().iter().any(|name| name == "leave-test");
        // A thread sets its own name when it starts.
        while !is_there() {
            thread::yield_now();
        }
        drop((end, job));
        while is_there() {
            thread::yield_now();
        }
    }
}
