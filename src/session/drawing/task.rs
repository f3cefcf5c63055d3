//! Tasks read the targets' contents back, on the drawing thread.
//!
//! Adding a task returns a [`Ticket`], which has the output once the job's picture is back. Dropping a ticket drops the
//! output; the output of a device that was abandoned never arrives.

use super::renderer::Renderer;
use std::{
    sync::mpsc::{Receiver, channel},
    time::{Duration, Instant},
};

/// A read-back, which runs after the frame of its job.
pub(crate) trait RenderTask: Send + 'static {
    type Output: Send + 'static;

    /// Runs on the drawing thread.
    fn run(self, renderer: &mut Renderer) -> Self::Output;
}

/// An output and its duration.
#[derive(Debug)]
pub(crate) struct Finished<T> {
    pub output: T,
    pub took: Duration,
}

/// Delivers an output to its ticket.
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
            // The output of a dropped ticket is discarded.
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

/// Receives the output of the newest task of a kind. The default belongs to no task.
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
