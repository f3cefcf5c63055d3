//! One thread that does the newest job it was given.
//!
//! Owns the hand-over: jobs that a newer one has overtaken are not begun, results that a newer job has made stale are
//! not handed out, and a panic in a job ends the job and not the program. Does not know what a job is.

use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        mpsc::{self, Receiver, Sender},
    },
    thread::JoinHandle,
};

/// A job ended in a panic; what it said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Panicked(pub String);

pub struct Worker<Job, Done> {
    /// `None` when no more will come.
    jobs: Option<Sender<(u64, Job)>>,
    results: Receiver<(u64, Result<Done, Panicked>)>,
    thread: Option<JoinHandle<()>>,
    newest: u64,
    is_busy: bool,
}

impl<Job: Send + 'static, Done: Send + 'static> Worker<Job, Done> {
    /// `wake` is called on the worker's thread after each job.
    pub fn new(
        name: &str,
        wake: Arc<dyn Fn() + Send + Sync>,
        mut work: impl FnMut(Job) -> Done + Send + 'static,
    ) -> std::io::Result<Self> {
        let (jobs, inbox) = mpsc::channel::<(u64, Job)>();
        let (outbox, results) = mpsc::channel();
        let thread = std::thread::Builder::new().name(name.into()).spawn(move || {
            while let Ok(first) = inbox.recv() {
                let (id, job) = inbox.try_iter().last().unwrap_or(first);
                let done = catch_unwind(AssertUnwindSafe(|| work(job))).map_err(|p| Panicked(panic_text(&*p)));
                if outbox.send((id, done)).is_err() {
                    return;
                }
                wake();
            }
        })?;
        Ok(Self { jobs: Some(jobs), results, thread: Some(thread), newest: 0, is_busy: false })
    }

    /// Gives the worker something newer to do.
    pub fn submit(&mut self, job: Job) {
        self.newest += 1;
        if let Some(jobs) = &self.jobs {
            self.is_busy = jobs.send((self.newest, job)).is_ok();
        }
    }

    /// Lets go of the thread: it ends when it has ended its job, and nobody waits for that.
    pub fn leave(&mut self) {
        self.jobs = None;
        self.thread = None;
    }

    /// Nobody wants what comes of the jobs so far.
    pub fn forget(&mut self) {
        self.newest += 1;
        self.is_busy = false;
    }

    /// The newest job has not ended yet.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// The result of the newest job, once. Never waits.
    pub fn take(&mut self) -> Option<Result<Done, Panicked>> {
        let newest = self.newest;
        let (_, done) = self.results.try_iter().filter(|(id, _)| *id == newest).last()?;
        self.is_busy = false;
        Some(done)
    }
}

impl<Job, Done> Drop for Worker<Job, Done> {
    /// Lets the job under way end: a thread inside the graphics driver must not outlive the device.
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn panic_text(payload: &(dyn Any + Send)) -> String {
    payload
        .downcast_ref::<&str>()
        .map(|s| (*s).to_owned())
        .or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason given".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    fn wait<J: Send + 'static, D: Send + 'static>(w: &mut Worker<J, D>) -> Result<D, Panicked> {
        let end = Instant::now() + Duration::from_secs(10);
        loop {
            if let Some(done) = w.take() {
                return done;
            }
            assert!(Instant::now() < end, "the job never ended");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    #[test]
    fn the_newest_job_wins_and_overtaken_ones_are_not_begun() {
        let (begun, log) = mpsc::channel();
        let (go, gate) = mpsc::channel::<()>();
        let mut w = Worker::new("test", Arc::new(|| ()), move |n: u32| {
            begun.send(n).unwrap();
            gate.recv().unwrap();
            n * 10
        })
        .unwrap();
        w.submit(1);
        assert_eq!(log.recv().unwrap(), 1);
        for n in 2..=5 {
            w.submit(n);
        }
        go.send(()).unwrap();
        assert_eq!(log.recv().unwrap(), 5, "2 to 4 were overtaken");
        assert!(w.take().is_none(), "the result of 1 is stale");
        assert!(w.is_busy());
        go.send(()).unwrap();
        assert_eq!(wait(&mut w), Ok(50));
        assert!(!w.is_busy());
        assert!(w.take().is_none(), "once");
    }

    #[test]
    fn what_is_forgotten_gives_no_result() {
        let mut w = Worker::new("test", Arc::new(|| ()), |n: u32| n).unwrap();
        w.submit(1);
        w.forget();
        assert!(!w.is_busy());
        w.submit(2);
        assert_eq!(wait(&mut w), Ok(2));
        w.submit(3);
        std::thread::sleep(Duration::from_millis(20));
        w.forget();
        assert!(w.take().is_none() && !w.is_busy());
    }

    #[test]
    fn a_panic_is_a_result_and_the_worker_goes_on() {
        let mut w = Worker::new("test", Arc::new(|| ()), |n: u32| {
            assert!(n != 1, "one is too few");
            n
        })
        .unwrap();
        w.submit(1);
        assert_eq!(wait(&mut w), Err(Panicked("one is too few".into())));
        w.submit(2);
        assert_eq!(wait(&mut w), Ok(2));
    }

    #[test]
    fn wake_is_called_once_the_result_is_there() {
        let (woken, wakes) = mpsc::channel();
        let mut w = Worker::new("test", Arc::new(move || woken.send(()).unwrap()), |n: u32| n).unwrap();
        w.submit(3);
        wakes.recv_timeout(Duration::from_secs(10)).unwrap();
        assert_eq!(w.take(), Some(Ok(3)));
    }
}
