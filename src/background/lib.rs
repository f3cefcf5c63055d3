//! Background work on a thread: the newest job wins.
//!
//! Owns the hand-over: superseded jobs are not started, stale results (of a superseded or cancelled job) are not
//! returned, and a panic in a job becomes its error and does not end the program. This package does not know the
//! content of jobs.
//!
//! A job's progress is a value that it replaces ([`Control::report`]) or adds to ([`Control::update`]). Where every event
//! counts, it is a list of events, which [`Background::take_progress`] empties.

#![warn(missing_docs)]

use std::{
    any::Any,
    mem,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
        mpsc::{self, Receiver, Sender},
    },
    thread::{self, JoinHandle},
    time::{Duration, Instant},
};

/// A callback that is called on another thread when there is something to poll.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

type Spawn = Box<dyn FnOnce() -> std::io::Result<JoinHandle<()>> + Send>;

/// A thread that turns an `In` into an `Out` or an error message, and reports `Progress`.
pub struct Background<In, Progress, Out> {
    wake: Wake,
    /// `None` when no more jobs will follow.
    jobs: Option<Sender<Job<In, Progress>>>,
    results: Receiver<(u64, Result<Out, String>)>,
    /// Starts the thread, if the first job is to do that.
    spawn: Option<Spawn>,
    thread: Option<JoinHandle<()>>,
    /// The number of the newest job.
    newest: u64,
    input: Input,
    is_busy: bool,
    control: Control<Progress>,
    /// The progress that [`Background::poll`] has already reported.
    polled: Progress,
    result: Option<Result<Out, String>>,
}

struct Job<In, Progress> {
    number: u64,
    input: In,
    control: Control<Progress>,
}

/// The input of a job that was requested and has not started yet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Input {
    #[default]
    None,
    Requested,
    /// The input is being prepared.
    InProgress,
}

/// The state of the work, as shown by a front end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Status<'w, Progress, Out> {
    /// It was requested or is running, with its progress.
    UnderWay(Progress),
    /// Its result, or the reason why there is none.
    Ended(Result<&'w Out, &'w str>),
}

/// Progress as a number of items out of a total.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// The number of items that are done.
    pub done: usize,
    /// The total.
    pub of: usize,
}

/// The job's handle for reporting progress, and for checking whether the job is cancelled.
pub struct Control<Progress> {
    shared: Arc<Shared<Progress>>,
    wake: Wake,
}

#[derive(Default)]
struct Shared<Progress> {
    progress: Mutex<Progress>,
    is_cancelled: Arc<AtomicBool>,
}

impl<Progress> Clone for Control<Progress> {
    fn clone(&self) -> Self {
        Self { shared: self.shared.clone(), wake: self.wake.clone() }
    }
}

impl<Progress: Clone + Default> Control<Progress> {
    fn new(wake: Wake) -> Self {
        Self { shared: Arc::default(), wake }
    }

    /// Reports progress.
    pub fn report(&self, progress: Progress) {
        self.update(|shared| *shared = progress);
    }

    /// Changes the progress of the job, and wakes the owner.
    pub fn update(&self, change: impl FnOnce(&mut Progress)) {
        change(&mut self.shared.progress.lock().unwrap_or_else(|e| e.into_inner()));
        (self.wake)();
    }

    /// Returns the flag that is set when the work is to end, for code that does not know a `Control`.
    pub fn cancel_flag(&self) -> Arc<AtomicBool> {
        self.shared.is_cancelled.clone()
    }

    /// Returns whether the job is cancelled: its result will be dropped.
    pub fn is_cancelled(&self) -> bool {
        self.shared.is_cancelled.load(Ordering::Relaxed)
    }

    /// Returns an error if the job is cancelled, to leave it with `?`.
    pub fn check(&self) -> Result<(), String> {
        if self.is_cancelled() { Err("cancelled".to_owned()) } else { Ok(()) }
    }

    fn cancel(&self) {
        self.shared.is_cancelled.store(true, Ordering::Relaxed);
    }

    fn progress(&self) -> Progress {
        self.shared.progress.lock().unwrap_or_else(|e| e.into_inner()).clone()
    }
}

impl<In, Progress, Out> Background<In, Progress, Out>
where
    In: Send + 'static,
    Progress: Clone + Default + PartialEq + Send + 'static,
    Out: Send + 'static,
{
    /// Starts a thread of this name. `what` is the subject of the message about a panic, as in "the search failed";
    /// `wake` is called on the thread after each job and each report.
    pub fn new(
        name: &str,
        what: &'static str,
        wake: Wake,
        work: impl FnMut(In, &Control<Progress>) -> Result<Out, String> + Send + 'static,
    ) -> std::io::Result<Self> {
        let mut background = Self::lazy(name, what, wake, work);
        background.thread = background.spawn.take().map(|spawn| spawn()).transpose()?;
        Ok(background)
    }

    /// Does the same, but the first job starts the thread, and fails if that is not possible.
    pub fn lazy(
        name: &str,
        what: &'static str,
        wake: Wake,
        mut work: impl FnMut(In, &Control<Progress>) -> Result<Out, String> + Send + 'static,
    ) -> Self {
        let (jobs, queue) = mpsc::channel::<Job<In, Progress>>();
        let (sender, results) = mpsc::channel();
        let (name, wake_caller) = (name.to_owned(), wake.clone());
        let run = move || {
            while let Ok(first) = queue.recv() {
                let Job { number, input, control } = queue.try_iter().last().unwrap_or(first);
                let result = catch_unwind(AssertUnwindSafe(|| work(input, &control)))
                    .unwrap_or_else(|p| Err(format!("this is a bug in Eddy: {what} failed ({})", panic_text(&*p))));
                if sender.send((number, result)).is_err() {
                    return;
                }
                wake_caller();
            }
        };
        let control = Control::new(wake.clone());
        Self {
            wake,
            jobs: Some(jobs),
            results,
            spawn: Some(Box::new(move || thread::Builder::new().name(name).spawn(run))),
            thread: None,
            newest: 0,
            input: Input::None,
            is_busy: false,
            control,
            polled: Progress::default(),
            result: None,
        }
    }

    /// Requests a newer result, whose input does not exist yet. The last result stays until then, and so does the job
    /// in progress.
    pub fn request(&mut self) {
        self.input = Input::Requested;
    }

    /// Returns whether an input should be prepared now, once per request.
    pub fn take_request(&mut self) -> bool {
        let is_requested = self.input == Input::Requested;
        if is_requested {
            self.input = Input::InProgress;
        }
        is_requested
    }

    /// Repeats the request if its input was in preparation and will not arrive.
    pub fn renew_request(&mut self) {
        if self.input == Input::InProgress {
            self.input = Input::Requested;
        }
    }

    /// Starts a newer job. The previous one is cancelled.
    pub fn start(&mut self, input: In) {
        self.control.cancel();
        self.control = Control::new(self.wake.clone());
        self.newest += 1;
        self.input_has_come();
        match self.spawn.take().map(|spawn| spawn()).transpose() {
            Ok(Some(thread)) => self.thread = Some(thread),
            Ok(None) => {}
            Err(e) => self.result = Some(Err(format!("cannot start a thread: {e}"))),
        }
        if let Some(jobs) = &self.jobs {
            self.is_busy = jobs.send(Job { number: self.newest, input, control: self.control.clone() }).is_ok();
        }
    }

    /// Ends a request with an error, because its input cannot be prepared.
    pub fn fail(&mut self, why: impl Into<String>) {
        self.input_has_come();
        self.result = Some(Err(why.into()));
    }

    fn input_has_come(&mut self) {
        if self.input == Input::InProgress {
            self.input = Input::None;
        }
    }

    /// Ends the request and the job in progress without a result. The last result stays.
    pub fn cancel(&mut self) {
        self.control.cancel();
        self.newest += 1;
        (self.input, self.is_busy) = (Input::None, false);
    }

    /// Asks the newest job to end soon. Unlike a cancelled job's, its result counts.
    pub fn stop(&self) {
        self.control.cancel();
    }

    /// Returns whether the newest job was asked to end and has not yet.
    pub fn is_stopping(&self) -> bool {
        self.is_busy && self.control.is_cancelled()
    }

    /// Takes the progress of the newest job, and leaves the default in its place.
    pub fn take_progress(&mut self) -> Progress {
        mem::take(&mut self.control.shared.progress.lock().unwrap_or_else(|e| e.into_inner()))
    }

    /// Cancels, and drops the last result too.
    pub fn clear(&mut self) {
        self.cancel();
        self.result = None;
    }

    /// Receives results and progress of the newest job. Returns whether there are any new ones.
    pub fn poll(&mut self) -> bool {
        let newest = self.newest;
        if let Some((_, result)) = self.results.try_iter().filter(|(number, _)| *number == newest).last() {
            (self.is_busy, self.result) = (false, Some(result));
            return true;
        }
        let progress = self.control.progress();
        mem::replace(&mut self.polled, progress.clone()) != progress
    }

    /// Polls, and returns the result of the newest job once.
    pub fn take(&mut self) -> Option<Result<Out, String>> {
        self.poll();
        self.result.take()
    }

    /// Returns the last result, even while a newer one is in progress.
    pub fn result(&self) -> Option<&Result<Out, String>> {
        self.result.as_ref()
    }

    /// Returns `None` if nothing was requested since the last [`Background::clear`].
    pub fn status(&self) -> Option<Status<'_, Progress, Out>> {
        if self.is_under_way() {
            return Some(Status::UnderWay(self.control.progress()));
        }
        self.result.as_ref().map(|result| Status::Ended(result.as_ref().map_err(String::as_str)))
    }

    /// Returns whether something was requested or started that has no result yet.
    pub fn is_under_way(&self) -> bool {
        self.input != Input::None || self.is_busy
    }

    /// Returns whether the newest job has not ended yet.
    pub fn is_busy(&self) -> bool {
        self.is_busy
    }

    /// Detaches the thread: it ends after its job, without anyone waiting for it.
    pub fn leave(&mut self) {
        self.jobs = None;
        self.thread = None;
    }

    /// Returns it after [`Background::leave`]. For a job that may wait for a person or for another program.
    #[must_use]
    pub fn detached(mut self) -> Self {
        self.leave();
        self
    }

    /// Cancels, and returns the thread for someone else to wait for, as dropping this would do.
    #[must_use]
    pub fn abandon(mut self) -> Option<JoinHandle<()>> {
        self.cancel();
        self.jobs = None;
        self.thread.take()
    }

    /// Cancels, and waits up to `patience` for the thread to end. Returns false if it is still running; it is then
    /// detached.
    pub fn end(&mut self, patience: Duration) -> bool {
        self.cancel();
        self.jobs = None;
        let Some(thread) = self.thread.take() else { return true };
        let end = Instant::now() + patience;
        while !thread.is_finished() {
            if Instant::now() >= end {
                return false;
            }
            thread::sleep(Duration::from_millis(2));
        }
        true
    }
}

impl<Progress, Out> Background<(), Progress, Out>
where
    Progress: Clone + Default + PartialEq + Send + 'static,
    Out: Send + 'static,
{
    /// Starts a thread for one job, which ends with the job. The rest is as with [`Background::new`].
    pub fn once(
        name: &str,
        what: &'static str,
        wake: Wake,
        work: impl FnOnce(&Control<Progress>) -> Result<Out, String> + Send + 'static,
    ) -> std::io::Result<Self> {
        let mut work = Some(work);
        let mut once = Self::new(name, what, wake, move |(), control| match work.take() {
            Some(work) => work(control),
            None => Err(format!("{what} has ended")),
        })?;
        once.start(());
        once.jobs = None;
        Ok(once)
    }
}

impl<In, Progress, Out> Drop for Background<In, Progress, Out> {
    /// Waits for the job in progress: a thread inside the graphics driver must not outlive the device.
    fn drop(&mut self) {
        self.control.shared.is_cancelled.store(true, Ordering::Relaxed);
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
mod tests;
