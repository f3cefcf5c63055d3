//! Job objects of Windows: a group of processes that ends with the last handle to it.

use std::{
    io,
    os::windows::io::{AsRawHandle, FromRawHandle, OwnedHandle},
    process::Child,
    ptr,
};
use windows_sys::Win32::System::JobObjects::{
    AssignProcessToJobObject, CreateJobObjectW, JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE,
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION, JobObjectExtendedLimitInformation, SetInformationJobObject,
    TerminateJobObject,
};

/// A process and those that it starts. The system ends all of them when this value is dropped, also if that is because
/// this process was killed: a `ffmpeg` on the path may be a small program that starts the real one.
#[derive(Debug)]
pub(super) struct Job(OwnedHandle);

impl Job {
    /// Puts a child into a new job. What the child has started before is not in it.
    pub(super) fn of(child: &Child) -> io::Result<Self> {
        // SAFETY: neither a name nor attributes are given.
        let job = unsafe { CreateJobObjectW(ptr::null(), ptr::null()) };
        if job.is_null() {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: the handle is open, and this value owns it.
        let job = unsafe { OwnedHandle::from_raw_handle(job) };
        let mut limits = JOBOBJECT_EXTENDED_LIMIT_INFORMATION::default();
        limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
        let size = size_of::<JOBOBJECT_EXTENDED_LIMIT_INFORMATION>() as u32;
        let limits = ptr::from_ref(&limits).cast();
        // SAFETY: the handle is open, and the information is that of this class, with its size.
        let is_set =
            unsafe { SetInformationJobObject(job.as_raw_handle(), JobObjectExtendedLimitInformation, limits, size) };
        if is_set == 0 {
            return Err(io::Error::last_os_error());
        }
        // SAFETY: both handles are open.
        if unsafe { AssignProcessToJobObject(job.as_raw_handle(), child.as_raw_handle()) } == 0 {
            return Err(io::Error::last_os_error());
        }
        Ok(Self(job))
    }

    /// Ends all processes of the job.
    pub(super) fn terminate(&self) {
        // SAFETY: the handle is open.
        unsafe { TerminateJobObject(self.0.as_raw_handle(), 1) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{
        process::{Command, Stdio},
        thread,
        time::{Duration, Instant},
    };

    /// The system closes the handles of a killed process as it closes this one.
    #[test]
    fn a_child_ends_with_its_job() {
        let mut command = Command::new("cmd");
        // It waits for a line.
        command.args(["/c", "set /p line="]).stdin(Stdio::piped());
        let mut child = command.spawn().expect("cmd is a part of Windows");
        let job = Job::of(&child).expect("a job");
        thread::sleep(Duration::from_millis(200));
        assert_eq!(child.try_wait().expect("its state"), None);
        drop(job);
        let began = Instant::now();
        while child.try_wait().expect("its state").is_none() {
            assert!(began.elapsed() < Duration::from_secs(10), "it still runs");
            thread::sleep(Duration::from_millis(5));
        }
    }
}
