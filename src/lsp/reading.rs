//! A program that is read on a thread of its own, so that the server answers meanwhile and gives up what is outdated.

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
    /// The program, or `None` where the reading was given up. Closed without either after a panic.
    result: Receiver<Option<Box<Program>>>,
}

/// The state of a reading.
pub(crate) enum Progress {
    Reading,
    Read(Box<Program>),
    /// It was given up, or has panicked.
    Ended {
        has_failed: bool,
    },
}

impl Reading {
    /// Starts to read a program, which has nothing of what was read of it before but what it keeps for that.
    pub fn start(mut program: Program, documents: Documents) -> io::Result<Self> {
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

    /// A text of the program has changed: what is being read is given up at the next statement.
    pub fn give_up(&self) {
        self.is_outdated.store(true, Ordering::Relaxed);
    }

    /// Waits for the result for at most so long.
    pub fn wait(&self, patience: Duration) -> Progress {
        match self.result.recv_timeout(patience) {
            Ok(Some(program)) => Progress::Read(program),
            Ok(None) => Progress::Ended { has_failed: false },
            Err(RecvTimeoutError::Timeout) => Progress::Reading,
            Err(RecvTimeoutError::Disconnected) => Progress::Ended { has_failed: true },
        }
    }
}
