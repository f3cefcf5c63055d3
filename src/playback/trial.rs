//! Trial compiles in a separate process, which is killed if the driver takes too long or too much memory.
//!
//! Owns both ends: the parent, which starts this program again and waits for it ([`TrialSettings::trial`]), and the
//! child, which compiles a project as the parent would and draws one pixel of each pass ([`serve`]). Mesa caches
//! compiled shaders on disk, so that the parent does not compile them a second time.

use eddy_engine::{BuildOptions, DrawFor, FrameInputs, Trial, TrialError, TrialOrder};
use eddy_gpu::{AdapterChoice, Gpu, GpuOptions};
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

use crate::{offline::Offline, script::ScriptedInputs, usage};

/// The command of this program that [`serve`] implements.
pub const COMMAND: &str = "try-compile";

/// The CPU time that a driver may take for a pass.
const LIMIT: Duration = Duration::from_secs(8);
/// A process that takes this many times its limit in wall-clock time is waiting for something: a machine that busy
/// tells nothing about the shader.
const PATIENCE: u32 = 8;
/// The frame rate of the frame that is drawn.
const FPS: f64 = 60.0;
const LOOK: Duration = Duration::from_millis(4);

/// The messages of a child that ends itself.
const OVER_TIME: &str = "time";
const OVER_MEMORY: &str = "memory";

/// The settings of trials of large programs, before the driver gets them in this process.
#[derive(Clone, Debug)]
pub struct TrialSettings {
    /// The path of an Eddy executable.
    pub program: PathBuf,
    /// The CPU time that a driver may take for a pass.
    pub limit: Duration,
}

impl TrialSettings {
    /// Trials by this program, with a limit other than the default if one is given. `None` if its executable cannot be
    /// found.
    pub fn of_this_program(limit: Option<Duration>) -> Option<Self> {
        let program = std::env::current_exe().ok()?;
        Some(Self { program, limit: limit.unwrap_or(LIMIT) })
    }

    /// Returns the trial for builds with Shadertoy's pictures from `media`. A running trial is cancelled when `jobs`
    /// changes: its result is no longer needed.
    pub fn trial(&self, media: Option<PathBuf>, jobs: Arc<AtomicU64>) -> Trial {
        let settings = self.clone();
        Trial::new(move |order| settings.run(order, media.clone(), &jobs))
    }

    /// A project that cannot be passed on, or a machine that cannot start a process, does not reject a program.
    fn run(
        &self,
        TrialOrder { project, requested: wanted, skip, adapter }: TrialOrder<'_>,
        media: Option<PathBuf>,
        jobs: &AtomicU64,
    ) -> Result<(), TrialError> {
        let Ok(snapshot) = project::write_snapshot(project) else { return Ok(()) };
        let request = Request {
            snapshot,
            wanted: wanted.iter().map(|pass| pass.key().to_owned()).collect(),
            skip,
            adapter: adapter.to_owned(),
            media,
            limit_secs: self.limit.as_secs_f64(),
        };
        let mut command = Command::new(&self.program);
        command.arg(COMMAND).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let Ok(mut child) = usage::open_no_console(&mut command).spawn() else { return Ok(()) };
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
            _ if usage::crashed(status) => Err(TrialError::Crash),
            _ => Ok(()),
        }
    }

    /// `None` for a process that was killed.
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

/// The project and the settings that the child receives.
#[derive(Serialize, Deserialize)]
struct Request {
    snapshot: String,
    wanted: Vec<String>,
    skip: bool,
    adapter: String,
    media: Option<PathBuf>,
    limit_secs: f64,
}

/// Compiles the project of a request and draws it, in a process that ends itself if the driver exceeds a limit. Errors
/// are ignored by the parent, which will encounter them itself.
pub fn serve(mut request: impl Read) -> Result<(), Box<dyn std::error::Error>> {
    let mut text = String::new();
    request.read_to_string(&mut text)?;
    let Request { snapshot, wanted, skip, adapter, media, limit_secs } = serde_json::from_str(&text)?;
    let wanted: Vec<PassName> = wanted.iter().filter_map(|key| PassName::parse(key)).collect();
    let gpu = Gpu::new(&GpuOptions { adapter: AdapterChoice::Named(adapter), ..GpuOptions::default() })?;
    if !gpu.compiles_here {
        return Ok(());
    }
    let step = Arc::new(AtomicU64::new(0));
    let guard = Guard { step: step.clone(), limit: Duration::try_from_secs_f64(limit_secs)? };
    guard.start_watching()?;
    let mut project = project::read_snapshot(&snapshot)?;
    project.read_includes();
    let (media, _) = media::gather(&project, media.as_deref());
    // One pixel: the driver compiles whatever the size.
    let mut offline = Offline::new(&gpu, (1, 1), ScriptedInputs::new(FPS))?;
    let is_sound = wanted == [PassName::sound()];
    let options = BuildOptions { requested: wanted, skip, ..BuildOptions::default() };
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

/// Ends the process if it takes too much.
struct Guard {
    /// Each change restarts the driver's time limit.
    step: Arc<AtomicU64>,
    limit: Duration,
}

impl Guard {
    fn start_watching(self) -> std::io::Result<()> {
        usage::crash_silently();
        thread::Builder::new().name("guard".into()).spawn(move || self.watch())?;
        Ok(())
    }

    fn watch(self) {
        let (mut step, mut began) = (0, usage::processor_time());
        loop {
            thread::sleep(LOOK);
            let now = self.step.load(Ordering::Relaxed);
            if now != step {
                (step, began) = (now, usage::processor_time());
            }
            if usage::processor_time().saturating_sub(began) > self.limit {
                leave(OVER_TIME);
            }
            if usage::memory() > limits::DRIVER_BYTES {
                leave(OVER_MEMORY);
            }
        }
    }
}

/// Ends the process at once: the driver's threads do not end by themselves.
fn leave(word: &str) -> ! {
    let mut out = std::io::stdout();
    let _ = writeln!(out, "{word}").and_then(|()| out.flush());
    usage::end_at_once()
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
        settings.run(TrialOrder { project: &project, requested: &[], skip: true, adapter: "" }, None, jobs)
    }

    #[test]
    fn child_reports_why_it_ended() {
        let jobs = AtomicU64::new(0);
        assert_eq!(tried("exit 0", &jobs), Ok(()));
        assert_eq!(tried("echo time; kill -ABRT $$", &jobs), Err(TrialError::Time(Duration::from_secs(60))));
        assert_eq!(tried("echo memory; kill -ABRT $$", &jobs), Err(TrialError::Memory));
        assert_eq!(tried("kill -SEGV $$", &jobs), Err(TrialError::Crash));
    }

    /// Its errors are not the shader's: the parent will encounter them itself.
    #[test]
    fn failing_child_rejects_no_program() {
        assert_eq!(tried("exit 1", &AtomicU64::new(0)), Ok(()));
        let settings = TrialSettings { program: "/nonexistent/eddy".into(), limit: Duration::from_secs(60) };
        let project = Project::of_image("Untitled".into(), IMAGE.into());
        let order = TrialOrder { project: &project, requested: &[], skip: true, adapter: "" };
        assert_eq!(settings.run(order, None, &AtomicU64::new(0)), Ok(()));
    }

    #[test]
    fn newer_job_cancels_the_previous_trial() {
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
