//! Compiles stages in parallel before they are requested one by one.

use super::{
    Sources,
    compile::PassOptions,
    host,
    stage_cache::{self, CacheMiss, Outcome, StageCache},
};
use eddy_glsl::{Link, PassSource};
use eddy_project::Stage;
use std::{
    cmp::Reverse,
    num::NonZero,
    panic::resume_unwind,
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

/// The bytes of GLSL that justify another thread: they compile in a third of a millisecond.
const MIN_BYTES_PER_THREAD: usize = 8 << 10;

/// A stage to compile: of `project.passes[index]`, for the cache.
struct Job {
    /// The total bytes of its texts.
    text: usize,
    index: usize,
    options: PassOptions,
    stage: Box<CacheMiss>,
}

impl Sources<'_> {
    /// Compiles the stages of these passes that the cache lacks, if there is enough work for several threads. Programs
    /// that draw meshes are omitted, as one stage depends on the other.
    pub(super) fn compile_ahead(&self, cache: &mut StageCache, passes: impl IntoIterator<Item = (usize, PassOptions)>) {
        let mut jobs: Vec<Job> = Vec::new();
        for (index, options) in passes {
            if !self.project.passes[index].body.is_screen() {
                continue;
            }
            self.with_screen(index, options, |source| {
                let found = cache.find(source, &Link::default(), |text| self.shared(text));
                if let Err(stage) = found
                    && !jobs.iter().any(|job| job.stage == stage)
                {
                    let text = source.code.text.len() + source.common.map_or(0, |common| common.text.len());
                    jobs.push(Job { text, index, options, stage });
                }
            });
        }
        let cores = || thread::available_parallelism().map_or(1, NonZero::get);
        let text: usize = jobs.iter().map(|job| job.text).sum();
        let threads = jobs.len().min(text / MIN_BYTES_PER_THREAD);
        // Longest first, so that no thread starts the longest job when the others are nearly done.
        jobs.sort_by_key(|job| Reverse(job.text));
        if threads > 1 && cores() > 1 {
            let outcomes = self.compile_jobs(&jobs, threads.min(cores()));
            for (job, outcome) in jobs.into_iter().zip(outcomes) {
                cache.add(job.stage, outcome);
            }
        }
    }

    /// Compiles the jobs; each thread takes the next one.
    fn compile_jobs(&self, jobs: &[Job], threads: usize) -> Vec<Outcome> {
        // Read it here once, instead of in each thread.
        let preamble = self.preamble();
        let next = AtomicUsize::new(0);
        let work = || {
            let mut done = Vec::new();
            loop {
                let at = next.fetch_add(1, Ordering::Relaxed);
                let Some(job) = jobs.get(at) else { return done };
                let compile = |source: &PassSource<'_>| stage_cache::compile(source, &Link::default(), preamble);
                done.push((at, self.with_screen(job.index, job.options, compile)));
            }
        };
        let mut done = thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
            let mut done = work();
            for other in others {
                done.append(&mut other.join().unwrap_or_else(|panicked| resume_unwind(panicked)));
            }
            done
        });
        done.sort_unstable_by_key(|(at, _)| *at);
        done.into_iter().map(|(_, outcome)| outcome).collect()
    }

    /// Calls `work` with the compiler input for `project.passes[index]`, which draws the whole target.
    fn with_screen<T>(&self, index: usize, options: PassOptions, work: impl FnOnce(&PassSource<'_>) -> T) -> T {
        let kind = host::pass_kind(self.project, &self.project.passes[index]);
        let PassOptions { bilinear_in_shader, driver, probe, tiled } = options;
        self.with_source(index, self.stage_id(index, Stage::Own), kind, |source| {
            work(&PassSource { bilinear_in_shader, driver, probe, tiled, ..*source })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project as project;

    #[test]
    fn parallel_and_serial_compilation_agree() {
        for name in ["fluid", "scene-bloom-taa", "gallery-of-tricks"] {
            let project = project::presets::load(name).expect("a preset").project;
            let texts = Sources::new(&project);
            let options = PassOptions::default();
            let screens = (0..project.passes.len()).filter(|&i| project.passes[i].body.is_screen());
            let mut cache = StageCache::default();
            let mut jobs = Vec::new();
            for index in screens {
                texts.with_screen(index, options, |source| {
                    let found = cache.find(source, &Link::default(), |text| texts.shared(text));
                    jobs.extend(found.err().map(|stage| Job { text: source.code.text.len(), index, options, stage }));
                });
            }
            assert!(jobs.len() > 1, "{name}");
            let shown = |outcomes: Vec<Outcome>| outcomes.iter().map(|o| format!("{o:?}")).collect::<Vec<_>>();
            let alone = shown(Sources::new(&project).compile_jobs(&jobs, 1));
            assert!(alone.iter().all(|outcome| outcome.starts_with("Ok")), "{name}");
            assert_eq!(alone, shown(texts.compile_jobs(&jobs, 3)), "{name}");
        }
    }

    #[test]
    fn stages_compiled_ahead_are_in_the_cache() {
        let project = project::presets::load("fluid").expect("a preset").project;
        let texts = Sources::new(&project);
        let options = PassOptions::default();
        let mut cache = StageCache::default();
        texts.compile_ahead(&mut cache, (0..project.passes.len()).map(|index| (index, options)));
        let ahead = cache.end_build(true);
        for index in 0..project.passes.len() {
            texts.compile_pass_with(&mut cache, index, options).map(drop).expect("a preset without errors");
        }
        let cores = thread::available_parallelism().map_or(1, NonZero::get);
        let left = cache.end_build(true);
        assert_eq!((ahead == 0, left == 0), (cores == 1, cores > 1), "{ahead} ahead, {left} left");
    }
}
