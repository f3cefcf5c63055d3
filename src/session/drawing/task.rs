//! A task reads something back of what the targets hold, on the thread that draws.
//!
//! Owns the way of its output: whoever adds a task gets a [`Ticket`], and finds the output there once the job's picture
//! is back. A ticket that is dropped drops the output with it; the output of a device that was given up never comes.

use super::renderer::Renderer;
use std::{
    sync::mpsc::{Receiver, channel},
    time::{Duration, Instant},
};

/// A read-back, which runs behind the frame of the job that it goes with.
pub(crate) trait RenderTask: Send + 'static {
    type Output: Send + 'static;

    /// Runs on the thread that draws.
    fn run(self, renderer: &mut Renderer) -> Self::Output;
}

/// An output, and how long it took.
#[derive(Debug)]
pub(crate) struct Finished<T> {
    pub output: T,
    pub took: Duration,
}

/// Puts an output where its ticket finds it.
pub(super) type Delivery = Box<dyn FnOnce() + Send>;

type Run = Box<dyn FnOnce(&mut Renderer) -> Delivery + Send>;

/// The tasks of a job, in the order in which they run.
#[derive(Default)]
pub(crate) struct Tasks(Vec<Run>);

impl Tasks {
    pub(crate) fn add<T: RenderTask>(&mut self, task: T) -> Ticket<T::Output> {
        let (sender, receiver) = channel();
        self.0.push(Box::new(move |renderer| {
            let began = Instant::now();
            let output = task.run(renderer);
            let finished = Finished { output, took: began.elapsed() };
            // Nobody waits for the output of a ticket that was dropped.
            Box::new(move || _ = sender.send(finished))
        }));
        Ticket(Some(receiver))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn run(self, renderer: &mut Renderer) -> Vec<Delivery> {
        self.0.into_iter().map(|task| task(renderer)).collect()
    }
}

/// The place where the output of the newest task of a kind is found. The default is of no task.
#[derive(Debug)]
pub(crate) struct Ticket<T>(Option<Receiver<Finished<T>>>);

impl<T> Default for Ticket<T> {
    fn default() -> Self {
        Self(None)
    }
}

impl<T> Ticket<T> {
    /// Returns the output once, when the job's picture is back.
    pub(crate) fn take(&mut self) -> Option<Finished<T>> {
        self.0.as_ref()?.try_recv().ok().inspect(|_| self.0 = None)
    }

    /// A ticket with an output.
    #[cfg(test)]
    pub(crate) fn finished(output: T, took: Duration) -> Self {
        let (sender, receiver) = channel();
        sender.send(Finished { output, took }).unwrap_or_else(|_| unreachable!());
        Self(Some(receiver))
    }
}
