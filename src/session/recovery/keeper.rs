//! The thread that writes recovery files, and its handle.

use super::{
    left::{self, Left, Read},
    replaced,
    slot::Slot,
};
use eddy_project::{self as project, Project, write_snapshot};
use std::{
    collections::HashMap,
    io::{self, Write},
    path::PathBuf,
    sync::{
        Arc,
        mpsc::{self, Receiver, RecvTimeoutError, Sender},
    },
    thread::JoinHandle,
    time::{Duration, Instant, SystemTime},
};

/// The time for which changes are collected before they are written. Writing takes additional time, and both together
/// stay well below a second.
const GATHER: Duration = Duration::from_millis(300);
/// The interval after which a failed write is retried: the disk may have space by then.
const RETRY: Duration = Duration::from_secs(5);

enum Job {
    Keep(Box<Project>),
    Forget,
    Scan,
    Adopt(PathBuf),
    Discard(PathBuf),
    PutOff(PathBuf),
}

/// A message to the session.
pub(crate) enum News {
    /// All unsaved work that was found, newest first.
    Found(Vec<Left>),
    Trouble(String),
}

/// The handle of the thread. No call blocks.
pub(crate) struct Recovery {
    /// `None` only while dropping.
    jobs: Option<Sender<Job>>,
    news: Receiver<News>,
    thread: Option<JoinHandle<()>>,
}

impl Recovery {
    /// `wake` is called on the thread when there is a message.
    pub(crate) fn new(folder: PathBuf, wake: Arc<dyn Fn() + Send + Sync>) -> io::Result<Recovery> {
        Self::with_retry(folder, wake, RETRY)
    }

    /// The same with another retry interval.
    pub(super) fn with_retry(
        folder: PathBuf,
        wake: Arc<dyn Fn() + Send + Sync>,
        retry: Duration,
    ) -> io::Result<Recovery> {
        let (jobs, queue) = mpsc::channel();
        let (sender, news) = mpsc::channel();
        let (own, offered) = (None, HashMap::new());
        let keeper = Keeper { folder, retry, sender, wake, own, offered, is_failure_reported: false };
        let thread = std::thread::Builder::new().name("recovery".into()).spawn(move || keeper.run(&queue))?;
        Ok(Recovery { jobs: Some(jobs), news, thread: Some(thread) })
    }

    /// Stores a project that differs from the disk.
    pub(crate) fn keep(&self, project: &Project) {
        self.send(Job::Keep(Box::new(project.clone())));
    }

    /// Nothing is unsaved any longer.
    pub(crate) fn forget(&self) {
        self.send(Job::Forget);
    }

    /// Looks for unsaved work; the result is [`News::Found`].
    pub(crate) fn scan(&self) {
        self.send(Job::Scan);
    }

    /// Makes unsaved work that was found the open project's: its file is updated, and removed once everything is saved.
    pub(crate) fn adopt(&self, file: PathBuf) {
        self.send(Job::Adopt(file));
    }

    /// Removes unsaved work that was found.
    pub(crate) fn discard(&self, file: PathBuf) {
        self.send(Job::Discard(file));
    }

    /// Postpones unsaved work that was found.
    pub(crate) fn put_off(&self, file: PathBuf) {
        self.send(Job::PutOff(file));
    }

    pub(crate) fn take_news(&self) -> Option<News> {
        self.news.try_recv().ok()
    }

    fn send(&self, job: Job) {
        if let Some(jobs) = &self.jobs {
            // A thread that has ended reported its panic.
            let _ = jobs.send(job);
        }
    }
}

impl Drop for Recovery {
    /// Writes what is still pending.
    fn drop(&mut self) {
        self.jobs = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

struct Keeper {
    folder: PathBuf,
    retry: Duration,
    sender: Sender<News>,
    wake: Arc<dyn Fn() + Send + Sync>,
    /// The open project's slot, while it has something unsaved.
    own: Option<Slot>,
    /// Slots of work that was found and about which the user has not decided.
    offered: HashMap<PathBuf, Slot>,
    is_failure_reported: bool,
}

impl Keeper {
    fn run(mut self, queue: &Receiver<Job>) {
        let mut waiting: Option<(Instant, Box<Project>)> = None;
        loop {
            let job = match &waiting {
                None => queue.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some((due, _)) => match due.checked_duration_since(Instant::now()) {
                    Some(left) => queue.recv_timeout(left),
                    None => Err(RecvTimeoutError::Timeout),
                },
            };
            match job {
                Ok(Job::Keep(project)) => {
                    let due = Instant::now() + GATHER;
                    waiting = Some((waiting.map_or(due, |(before, _)| before.min(due)), project));
                }
                Ok(Job::Forget) => {
                    waiting = None;
                    let ended = self.own.take().map_or(Ok(()), |slot| slot.end(&self.folder));
                    self.report_failure("removed", ended);
                }
                Ok(job) => self.settle(job),
                Err(end) => {
                    if let Some((_, project)) = waiting.take() {
                        let written = self.write(&project);
                        self.is_failure_reported &= written.is_err();
                        if written.is_err() {
                            waiting = Some((Instant::now() + self.retry, project));
                        }
                        self.report_failure("written", written);
                    }
                    if end == RecvTimeoutError::Disconnected {
                        return;
                    }
                }
            }
        }
    }

    fn settle(&mut self, job: Job) {
        match job {
            Job::Scan => self.scan(),
            Job::Adopt(file) => {
                let own = std::mem::replace(&mut self.own, self.offered.remove(&file));
                let ended = own.map_or(Ok(()), |slot| slot.end(&self.folder));
                self.report_failure("removed", ended);
            }
            Job::Discard(file) => {
                let ended = self.offered.remove(&file).map_or(Ok(()), |slot| slot.end(&self.folder));
                self.report_failure("removed", ended);
            }
            // The lock is released with the slot, and the file stays.
            Job::PutOff(file) => drop(self.offered.remove(&file)),
            Job::Keep(_) | Job::Forget => {}
        }
    }

    fn write(&mut self, project: &Project) -> io::Result<()> {
        let text = write_snapshot(project).map_err(io::Error::other)?;
        let slot = match self.own.take() {
            Some(slot) => slot,
            None => Slot::take(&self.folder, project)?,
        };
        let data = &self.own.insert(slot).data;
        let name = data.file_name().unwrap_or_default().to_string_lossy().into_owned();
        project::write_into(&self.folder, &name, |file| file.write_all(text.as_bytes()))
    }

    fn scan(&mut self) {
        replaced::sweep(&self.folder, SystemTime::now());
        let slots = match Slot::left_over(&self.folder) {
            Ok(slots) => slots,
            Err(e) => return self.report_failure("looked for", Err(e)),
        };
        let mut found = Vec::new();
        for slot in slots {
            match left::read(&slot.data) {
                Read::Work(left) => {
                    found.push(*left);
                    self.offered.insert(slot.data.clone(), slot);
                }
                Read::Nothing => {
                    let ended = slot.end(&self.folder);
                    self.report_failure("removed", ended);
                }
                Read::Unreadable(why) => {
                    let file = slot.data.display();
                    self.say(News::Trouble(format!(
                        "unsaved work from a crash is in {file}, but cannot be read: {why}\nYou can copy the texts \
                         from that file; move it away to stop this message"
                    )));
                }
            }
        }
        found.sort_by_key(|left| std::cmp::Reverse(left.written));
        self.say(News::Found(found));
    }

    /// Reports a failure once, until a write succeeds again.
    fn report_failure(&mut self, what: &str, result: io::Result<()>) {
        let Err(e) = result else { return };
        if !std::mem::replace(&mut self.is_failure_reported, true) {
            let folder = self.folder.display();
            self.say(News::Trouble(format!(
                "unsaved work is not protected against a crash: a recovery file could not be {what} in {folder}: \
                 {e}\nSave often, or free disk space there"
            )));
        }
    }

    fn say(&self, news: News) {
        // A session that has ended needs no messages.
        if self.sender.send(news).is_ok() {
            (self.wake)();
        }
    }
}
