//! The processor time and the memory that this process has taken, its end, and the ends of other processes, by system.

use std::{
    process::{Command, ExitStatus},
    time::Duration,
};

/// Returns the CPU time that this process has taken.
#[cfg(unix)]
pub(crate) fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::new(time.tv_sec.try_into().unwrap_or(0), time.tv_nsec.try_into().unwrap_or(0))
}

/// Returns the CPU time that this process has taken, in its own code and in the system's.
#[cfg(windows)]
pub(crate) fn processor_time() -> Duration {
    use windows_sys::Win32::{
        Foundation::FILETIME,
        System::Threading::{GetCurrentProcess, GetProcessTimes},
    };
    let mut times = [FILETIME::default(); 4];
    let [created, ended, kernel, user] = &mut times;
    // SAFETY: the pseudo handle of this process is always valid, and all four times are written to.
    if unsafe { GetProcessTimes(GetCurrentProcess(), created, ended, kernel, user) } == 0 {
        return Duration::ZERO;
    }
    // A unit is 100 ns.
    let units = |time: &FILETIME| u64::from(time.dwHighDateTime) << 32 | u64::from(time.dwLowDateTime);
    Duration::from_nanos((units(kernel) + units(user)).saturating_mul(100))
}

/// Returns this process's memory use in bytes; 0 if that is unknown, as on macOS.
#[cfg(unix)]
pub(crate) fn memory() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let resident = pages.as_deref().and_then(|text| text.split(' ').nth(1)?.parse::<u64>().ok());
    resident.unwrap_or(0) * rustix::param::page_size() as u64
}

/// Returns this process's memory use in bytes; 0 if that is unknown. Pages that the system has moved to its file count, as
/// the working set becomes small when memory is short.
#[cfg(windows)]
pub(crate) fn memory() -> u64 {
    use windows_sys::Win32::System::{
        ProcessStatus::{K32GetProcessMemoryInfo, PROCESS_MEMORY_COUNTERS},
        Threading::GetCurrentProcess,
    };
    let mut counters = PROCESS_MEMORY_COUNTERS::default();
    let size = size_of::<PROCESS_MEMORY_COUNTERS>() as u32;
    // SAFETY: the pseudo handle of this process is always valid, and the counters have this size.
    let is_known = unsafe { K32GetProcessMemoryInfo(GetCurrentProcess(), &mut counters, size) } != 0;
    if is_known { counters.PagefileUsage as u64 } else { 0 }
}

/// Lets a crash of this process end it without a core file, and without a dialog.
pub(crate) fn crash_silently() {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, Rlimit, setrlimit};
        let _ = setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) });
    }
    #[cfg(windows)]
    {
        use windows_sys::Win32::System::Diagnostics::Debug::{
            SEM_FAILCRITICALERRORS, SEM_NOGPFAULTERRORBOX, SetErrorMode,
        };
        // SAFETY: it sets a flag of the process.
        unsafe { SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX) };
    }
}

/// Ends this process at once, without exit handlers of libraries: threads of a driver may be in the middle of work.
pub(crate) fn end_at_once() -> ! {
    #[cfg(windows)]
    {
        use windows_sys::Win32::System::Threading::{GetCurrentProcess, TerminateProcess};
        // SAFETY: the pseudo handle of this process is always valid. The call returns only if it fails.
        unsafe { TerminateProcess(GetCurrentProcess(), 1) };
    }
    // On Windows a report of the crash would be written first.
    std::process::abort()
}

/// Makes a command open no console next to a window. Consoles exist on Windows alone.
pub(crate) fn open_no_console(command: &mut Command) -> &mut Command {
    #[cfg(windows)]
    {
        use std::os::windows::process::CommandExt;
        use windows_sys::Win32::System::Threading::CREATE_NO_WINDOW;
        command.creation_flags(CREATE_NO_WINDOW);
    }
    command
}

/// Returns whether a process was ended by a fault of its own code.
#[cfg(unix)]
pub(crate) fn crashed(status: ExitStatus) -> bool {
    use std::os::unix::process::ExitStatusExt;
    status.signal().is_some()
}

/// Returns whether a process was ended by a fault of its own code.
#[cfg(windows)]
pub(crate) fn crashed(status: ExitStatus) -> bool {
    status.code().is_some_and(is_fault)
}

/// Returns whether an exit code of Windows is that of a fault. An unhandled exception becomes the exit code: a
/// status (`NTSTATUS`) whose two highest bits, its severity, are those of an error.
#[cfg(any(windows, test))]
fn is_fault(code: i32) -> bool {
    /// `STATUS_CONTROL_C_EXIT`: the user has ended the process.
    const CONTROL_C: u32 = 0xc000_013a;
    /// `STATUS_DLL_NOT_FOUND` and `STATUS_DLL_INIT_FAILED`: the process could not start, or the user logs off.
    const NOT_STARTED: [u32; 2] = [0xc000_0135, 0xc000_0142];
    let status = code as u32;
    status >= 0xc000_0000 && status != CONTROL_C && !NOT_STARTED.contains(&status)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_of_exceptions_are_faults() {
        // An access violation, a stack overflow, `abort`, an illegal instruction.
        for fault in [0xc000_0005_u32, 0xc000_00fd, 0xc000_0409, 0xc000_001d] {
            assert!(is_fault(fault as i32), "{fault:#x}");
        }
        // Success, an error, a panic of Rust, Ctrl+C, a missing library, one that does not start, a breakpoint.
        for other in [0_u32, 1, 101, 0xc000_013a, 0xc000_0135, 0xc000_0142, 0x8000_0003] {
            assert!(!is_fault(other as i32), "{other:#x}");
        }
    }

    /// The guard of trials compares both with limits. Other tests run in this process.
    #[test]
    #[cfg(any(target_os = "linux", windows))]
    fn work_takes_time_and_memory() {
        let began = processor_time();
        let mut bytes = vec![1_u8; 64 << 20];
        let mut passes = 0_u32;
        while processor_time() < began + Duration::from_millis(20) {
            passes += 1;
            assert!(passes < 10_000, "the time does not advance: {began:?}");
            bytes.iter_mut().for_each(|byte| *byte = byte.wrapping_mul(3));
        }
        let taken = memory();
        assert!(taken >= bytes.len() as u64 && taken < 1 << 36, "{taken} bytes, {} of them here", bytes.len());
    }
}
