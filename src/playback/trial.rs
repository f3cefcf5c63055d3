//! Trial compiles in a process of their own, which is ended where the driver takes too long or too much memory.
//!
//! Owns both ends: the parent, which starts this program once more and waits for it ([`TrialSettings::trial`]), and the
//! child, which compiles a project as the parent would and draws one pixel of each pass ([`serve`]). Mesa keeps what it
//! compiled in a cache on disk, so that the parent does not compile it a second time.

use eddy_engine::{BuildOptions, DrawFor, FrameInputs, Trial, TrialError, TrialOrder};
use eddy_gpu::{Gpu, GpuOptions};
use eddy_media as media;
use eddy_project::{self as project, PassName, limits};
use serde::{Deserialize, Serialize};
use std::{
    io::{Read, Write},
    path::PathBuf,
    process::{Child, Command, ExitStatus, Stdio},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

use crate::{offline::Offline, script::ScriptedInputs};

/// The command of this program that [`serve`] answers.
pub const COMMAND: &str = "try-compile";

/// The processor time that a driver may take for a pass.
const LIMIT: Duration = Duration::from_secs(8);
/// A process that takes so many times its limit by the clock waits for something: a machine that is as busy as that
/// says nothing about the shader.
const PATIENCE: u32 = 8;
/// Frames a second of the frame that is drawn.
const FPS: f64 = 60.0;
const LOOK: Duration = Duration::from_millis(4);

/// The words of a child that ends itself.
const OVER_TIME: &str = "time";
const OVER_MEMORY: &str = "memory";

/// The settings of trials of large programs, before the driver gets them in this process.
#[derive(Clone, Debug)]
pub struct TrialSettings {
    /// An Eddy.
    pub program: PathBuf,
    /// The processor time that a driver may take for a pass.
    pub limit: Duration,
}

impl TrialSettings {
    /// Trials by this program, with a limit other than the default where there is one. `None` where it cannot be found.
    pub fn of_this_program(limit: Option<Duration>) -> Option<Self> {
        let program = std::env::current_exe().ok()?;
        Some(Self { program, limit: limit.unwrap_or(LIMIT) })
    }

    /// Returns the trial for builds with pictures of the site from `media`. One that is under way when `jobs` changes
    /// is given up: its result is not wanted any more.
    pub fn trial(&self, media: Option<PathBuf>, jobs: Arc<AtomicU64>) -> Trial {
        let settings = self.clone();
        Trial::new(move |order| settings.run(order, media.clone(), &jobs))
    }

    /// A project that cannot be handed over, and a machine that starts no process, are no reasons to refuse a program.
    fn run(
        &self,
        TrialOrder { project, wanted, skip }: TrialOrder<'_>,
        media: Option<PathBuf>,
        jobs: &AtomicU64,
    ) -> Result<(), TrialError> {
        let Ok(snapshot) = project::write_snapshot(project) else { return Ok(()) };
        let request = Request {
            snapshot,
            wanted: wanted.iter().map(|pass| pass.key().to_owned()).collect(),
            skip,
            media,
            limit_secs: self.limit.as_secs_f64(),
        };
        let started = Command::new(&self.program)
            .arg(COMMAND)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let Ok(mut child) = started else { return Ok(()) };
        let text = serde_json::to_string(&request).unwrap_or_default();
        let sent = child.stdin.take().map(|mut input| input.write_all(text.as_bytes()));
        if !matches!(sent, Some(Ok(()))) {
            end(&mut child);
            return Ok(());
        }
        let Some(status) = self.wait(&mut child, jobs) else { return Ok(()) };
        let mut word = String::new();
        let _ = child.stdout.take().map(|out| out.take(64).read_to_string(&mut word));
        match word.trim() {
            OVER_TIME => Err(TrialError::Time(self.limit)),
            OVER_MEMORY => Err(TrialError::Memory),
            _ if crashed(status) => Err(TrialError::Crash),
            _ => Ok(()),
        }
    }

    /// `None` for a process that was given up.
    fn wait(&self, child: &mut Child, jobs: &AtomicU64) -> Option<ExitStatus> {
        let (job, began) = (jobs.load(Ordering::Relaxed), Instant::now());
        loop {
            match child.try_wait() {
                Ok(Some(status)) => return Some(status),
                Ok(None) if jobs.load(Ordering::Relaxed) == job && began.elapsed() < self.limit * PATIENCE => {
                    thread::sleep(LOOK);
                }
                _ => {
                    end(child);
                    return None;
                }
            }
        }
    }
}

fn end(child: &mut Child) {
    let _ = child.kill();
    let _ = child.wait();
}

#[cfg(unix)]
fn crashed(status: ExitStatus) -> bool {
    use std::os::unix::process::ExitStatusExt;
    status.signal().is_some()
}

#[cfg(not(unix))]
fn crashed(_: ExitStatus) -> bool {
    false
}

/// The project and the settings that the child is handed.
#[derive(Serialize, Deserialize)]
struct Request {
    snapshot: String,
    wanted: Vec<String>,
    skip: bool,
    media: Option<PathBuf>,
    limit_secs: f64,
}

/// Compiles the project of a request and draws it, in a process that ends itself where the driver goes too far. Errors
/// mean nothing to the parent, which will see them itself.
pub fn serve(mut request: impl Read) -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::new();
    request.read_to_string(&mut text)?;
    let Request { snapshot, wanted, skip, media, limit_secs } = serde_json::from_str(&text)?;
    let wanted: Vec<PassName> = wanted.iter().filter_map(|key| PassName::parse(key)).collect();
    let gpu = Gpu::new(&GpuOptions::default())?;
    if !gpu.compiles_here {
        return Ok(());
    }
    let step = Arc::new(AtomicU64::new(0));
    let guard = Guard { step: step.clone(), limit: Duration::try_from_secs_f64(limit_secs)? };
    guard.begin()?;
    let mut project = project::read_snapshot(&snapshot)?;
    project.read_includes();
    let (media, _) = media::gather(&project, media.as_deref());
    // One pixel: the driver compiles whatever the size.
    let mut offline = Offline::new(&gpu, (1, 1), ScriptedInputs::new(FPS))?;
    let is_sound = wanted == [PassName::sound()];
    let options = BuildOptions { wanted, skip, ..BuildOptions::default() };
    offline.build(&project, &media, &options)?;
    if is_sound {
        // One row of a block, which has a size of its own.
        let mut rows = Some(1);
        offline.into_engine()?.draw_sound(0, [0.0; 4], &mut || rows.take())?;
        return Ok(());
    }
    let mut next_pass = || {
        step.fetch_add(1, Ordering::Relaxed);
        0.0
    };
    offline.into_engine()?.draw_for(&FrameInputs::at_fixed_step(0, FPS), DrawFor::Timed(&mut next_pass))?;
    Ok(())
}

/// Ends the process where it takes too much.
struct Guard {
    /// Each change gives the driver its whole time again.
    step: Arc<AtomicU64>,
    limit: Duration,
}

impl Guard {
    fn begin(self) -> std::io::Result<()> {
        #[cfg(unix)]
        {
            use rustix::process::{Resource, Rlimit, setrlimit};
            // It ends by a signal, and leaves no core file behind.
            let _ = setrlimit(Resource::Core, Rlimit { current: Some(0), maximum: Some(0) });
        }
        thread::Builder::new().name("guard".into()).spawn(move || self.watch())?;
        Ok(())
    }

    fn watch(self) {
        let (mut step, mut began) = (0, processor_time());
        loop {
            thread::sleep(LOOK);
            let now = self.step.load(Ordering::Relaxed);
            if now != step {
                (step, began) = (now, processor_time());
            }
            if processor_time().saturating_sub(began) > self.limit {
                leave(OVER_TIME);
            }
            if memory() > limits::DRIVER_BYTES {
                leave(OVER_MEMORY);
            }
        }
    }
}

/// Ends the process at once: the driver's threads do not come to an end.
fn leave(word: &str) -> ! {
    let mut out = std::io::stdout();
    let _ = writeln!(out, "{word}").and_then(|()| out.flush());
    std::process::abort()
}

/// Returns the processor time that this process has taken.
#[cfg(unix)]
fn processor_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Duration::new(time.tv_sec.try_into().unwrap_or(0), time.tv_nsec.try_into().unwrap_or(0))
}

#[cfg(not(unix))]
fn processor_time() -> Duration {
    Duration::ZERO
}

/// Returns the bytes that this process holds in memory; 0 where that is not known.
fn memory() -> u64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let resident = pages.as_deref().and_then(|text| text.split(' ').nth(1)?.parse::<u64>().ok());
    resident.unwrap_or(0) * page_size()
}

#[cfg(unix)]
fn page_size() -> u64 {
    rustix::param::page_size() as u64
}

#[cfg(not(unix))]
fn page_size() -> u64 {
    0
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use eddy_project::Project;
    use std::os::unix::fs::PermissionsExt;

    const IMAGE: &str = "void mainImage(out vec4 o, in vec2 p) { o = vec4(1.0); }";

    /// Runs a trial whose child is this script.
    fn tried(script: &str, jobs: &AtomicU64) -> Result<(), TrialError> {
        let folder = tempfile::tempdir().expect("a folder");
        let program = folder.path().join("child");
        std::fs::write(&program, format!("#!/bin/sh\ncat > /dev/null\n{script}\n")).expect("a script");
        std::fs::set_permissions(&program, std::fs::Permissions::from_mode(0o700)).expect("it may run");
        let settings = TrialSettings { program, limit: Duration::from_secs(60) };
        let project = Project::of_image("Untitled".into(), IMAGE.into());
        settings.run(TrialOrder { project: &project, wanted: &[], skip: true }, None, jobs)
    }

    #[test]
    fn the_child_says_why_it_ended() {
        let jobs = AtomicU64::new(0);
        assert_eq!(tried("exit 0", &jobs), Ok(()));
        assert_eq!(tried("echo time; kill -ABRT $$", &jobs), Err(TrialError::Time(Duration::from_secs(60))));
        assert_eq!(tried("echo memory; kill -ABRT $$", &jobs), Err(TrialError::Memory));
        assert_eq!(tried("kill -SEGV $$", &jobs), Err(TrialError::Crash));
    }

    /// Its errors are not the shader's: the parent will see them itself.
    #[test]
    fn a_child_that_fails_or_does_not_start_refuses_nothing() {
        assert_eq!(tried("exit 1", &AtomicU64::new(0)), Ok(()));
        let settings = TrialSettings { program: "/nonexistent/eddy".into(), limit: Duration::from_secs(60) };
        let project = Project::of_image("Untitled".into(), IMAGE.into());
        let order = TrialOrder { project: &project, wanted: &[], skip: true };
        assert_eq!(settings.run(order, None, &AtomicU64::new(0)), Ok(()));
    }

    #[test]
    fn a_newer_job_ends_the_trial_of_the_one_before() {
        let jobs = AtomicU64::new(0);
        thread::scope(|scope| {
            let trial = scope.spawn(|| tried("exec sleep 600", &jobs));
            while !trial.is_finished() {
                jobs.fetch_add(1, Ordering::Relaxed);
                thread::sleep(LOOK);
            }
            assert_eq!(trial.join().expect("no panic"), Ok(()));
        });
    }
}
