//! Reads a program on a separate thread, so that the server can answer requests and cancel outdated readings.

use super::{
    documents::Documents,
    program::{Program, Root},
};
use eddy_glsl::cancel::cancellable;
use std::{
    io,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
        mpsc::{Receiver, RecvTimeoutError, channel},
    },
    time::Duration,
};

/// The stack of the thread: the main thread's on most systems.
const STACK: usize = 8 << 20;

/// A program that is being read.
pub(crate) struct Reading {
    pub root: Root,
    is_outdated: Arc<AtomicBool>,
    /// Receives the program, or `None` if the reading was cancelled. Closed without either after a panic.
    result: Receiver<Option<Box<Program>>>,
}

/// The state of a reading.
pub(crate) enum ReadingState {
    Reading,
    Read(Box<Program>),
    /// It was cancelled, or has panicked.
    Ended {
        has_failed: bool,
    },
}

impl Reading {
    /// Starts to read a program, which has only the data kept from its previous reading.
    pub(crate) fn start(mut program: Program, documents: Documents) -> io::Result<Self> {
        let (sender, result) = channel();
        let is_outdated = Arc::new(AtomicBool::new(false));
        let (root, flag) = (program.root.clone(), is_outdated.clone());
        std::thread::Builder::new().name("reading".into()).stack_size(STACK).spawn(move || {
            let read = cancellable(move || {
                program.read(&documents, &flag);
                Box::new(program)
            });
            // The server may have ended.
            let _ = sender.send(read);
        })?;
        Ok(Self { root, is_outdated, result })
    }

    /// Cancels the reading at the next statement, because a text of the program has changed.
    pub(crate) fn cancel(&self) {
        self.is_outdated.store(true, Ordering::Relaxed);
    }

    /// Waits for the result, at most for `patience`.
    pub(crate) fn wait(&self, patience: Duration) -> ReadingState {
        match self.result.recv_timeout(patience) {
            Ok(Some(program)) => ReadingState::Read(program),
            Ok(None) => ReadingState::Ended { has_failed: false },
            Err(RecvTimeoutError::Timeout) => ReadingState::Reading,
            Err(RecvTimeoutError::Disconnected) => ReadingState::Ended { has_failed: true },
        }
    }
}
