//! Keeps a device open while it is needed: it is opened on a separate thread, and reopened when it has vanished.

use crate::host::{DeviceError, Events, Opened};
use std::{
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
        mpsc::{Receiver, RecvTimeoutError, Sender, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// The time between two attempts to open a device.
const RETRY: Duration = Duration::from_secs(3);
/// The time after which an unneeded device is closed.
const IDLE: Duration = Duration::from_secs(20);
/// The time after which an order that a device did not accept is repeated.
const AGAIN: Duration = Duration::from_millis(30);

/// The state of a device.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum DeviceState {
    /// No device is needed.
    #[default]
    Closed,
    /// It plays or records.
    Open {
        /// The device's name.
        name: String,
        /// Samples per second of the device.
        rate: u32,
    },
    /// It could not be opened, or has vanished. Opening is retried.
    Missing(String),
}

/// A status that the thread writes and its owner reads.
#[derive(Default)]
struct Status {
    state: DeviceState,
    names: Option<Vec<String>>,
}

/// A use of a device: playing or recording.
pub(crate) trait Work: Send {
    /// An order from the owner.
    type Order: Send;

    /// Takes an order.
    fn take(&mut self, order: Self::Order);

    /// Returns whether the device is needed.
    fn needs_device(&self) -> bool;

    /// Returns whether the device stays open for a while after it is no longer needed.
    fn lingers(&self) -> bool {
        true
    }

    fn open(&mut self, name: Option<&str>, events: Events) -> Result<Opened, DeviceError>;

    /// Passes pending changes to the device. Returns false if the device did not accept them; they are retried.
    fn feed(&mut self) -> bool;

    /// Called when the device is closed.
    fn closed(&mut self);

    fn names(&mut self) -> Vec<String>;
}

enum Message<O> {
    Order(O),
    Device(Option<String>),
    Names,
    /// The device has vanished; contains the number of the opening that this is about.
    Gone(u64, String),
    End,
}

/// The owner's end of a kept device.
pub(crate) struct Keeper<W: Work> {
    link: Link<W>,
    status: Arc<Mutex<Status>>,
    underruns: Arc<AtomicU64>,
}

enum Link<W: Work> {
    Thread {
        to: Sender<Message<W::Order>>,
        thread: Option<JoinHandle<()>>,
    },
    /// Everything runs on the caller's thread: a test controls the time.
    Here {
        worker: Box<Worker<W>>,
        from: Receiver<Message<W::Order>>,
    },
}

impl<W: Work + 'static> Keeper<W> {
    /// Starts a thread. `wake` is called when the state of the device has changed.
    pub(crate) fn on_thread(name: &str, work: W, wake: Arc<dyn Fn() + Send + Sync>) -> std::io::Result<Self> {
        let (to, from) = channel();
        let mut worker = Worker::new(work, to.clone(), wake);
        let (status, underruns) = (worker.status.clone(), worker.underruns.clone());
        let thread = std::thread::Builder::new().name(name.into()).spawn(move || worker.run(&from))?;
        Ok(Self { link: Link::Thread { to, thread: Some(thread) }, status, underruns })
    }

    /// Creates a keeper without a thread: [`Keeper::step`] does the work.
    pub(crate) fn here(work: W) -> Self {
        let (to, from) = channel();
        let worker = Box::new(Worker::new(work, to, Arc::new(|| {})));
        let (status, underruns) = (worker.status.clone(), worker.underruns.clone());
        Self { link: Link::Here { worker, from }, status, underruns }
    }

    pub(crate) fn order(&mut self, order: W::Order) {
        self.send(Message::Order(order));
    }

    /// Requests a device by its name, or the system's default one.
    pub(crate) fn choose(&mut self, device: Option<String>) {
        self.send(Message::Device(device));
    }

    /// Requests the names of the devices, which become part of the status.
    pub(crate) fn ask_names(&mut self) {
        self.send(Message::Names);
    }

    fn send(&mut self, message: Message<W::Order>) {
        match &mut self.link {
            // A thread that has panicked plays nothing; drawing continues.
            Link::Thread { to, .. } => drop(to.send(message)),
            Link::Here { worker, .. } => worker.take(message),
        }
    }

    /// Does pending work if there is no thread.
    pub(crate) fn step(&mut self, now: Instant) {
        if let Link::Here { worker, from } = &mut self.link {
            while let Ok(message) = from.try_recv() {
                worker.take(message);
            }
            worker.step(now);
        }
    }

    pub(crate) fn state(&self) -> DeviceState {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).state.clone()
    }

    pub(crate) fn names(&self) -> Option<Vec<String>> {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).names.clone()
    }

    /// Returns the number of late buffers since the start.
    pub(crate) fn underruns(&self) -> u64 {
        self.underruns.load(Ordering::Relaxed)
    }
}

impl<W: Work> Drop for Keeper<W> {
    fn drop(&mut self) {
        if let Link::Thread { to, thread } = &mut self.link {
            let _ = to.send(Message::End);
            // A hanging driver must not keep the window from closing: the thread ends with the process.
            drop(thread.take());
        }
    }
}

struct Worker<W: Work> {
    work: W,
    device: Option<String>,
    opened: Option<Opened>,
    /// Counts openings: events of an earlier device are ignored.
    openings: u64,
    /// The time of the next attempt to open the device.
    retry_at: Option<Instant>,
    /// The time since which the device is not needed.
    idle_since: Option<Instant>,
    is_fed: bool,
    to: Sender<Message<W::Order>>,
    status: Arc<Mutex<Status>>,
    underruns: Arc<AtomicU64>,
    wake: Arc<dyn Fn() + Send + Sync>,
}

impl<W: Work + 'static> Worker<W> {
    fn new(work: W, to: Sender<Message<W::Order>>, wake: Arc<dyn Fn() + Send + Sync>) -> Self {
        Self {
            work,
            device: None,
            opened: None,
            openings: 0,
            retry_at: None,
            idle_since: None,
            is_fed: true,
            to,
            status: Arc::default(),
            underruns: Arc::default(),
            wake,
        }
    }

    fn run(&mut self, from: &Receiver<Message<W::Order>>) {
        let mut wait = None;
        loop {
            let message = match wait {
                None => from.recv().map_err(|_| RecvTimeoutError::Disconnected),
                Some(wait) => from.recv_timeout(wait),
            };
            match message {
                Ok(Message::End) | Err(RecvTimeoutError::Disconnected) => break,
                Ok(message) => self.take(message),
                Err(RecvTimeoutError::Timeout) => {}
            }
            while let Ok(message) = from.try_recv() {
                if matches!(message, Message::End) {
                    return self.close();
                }
                self.take(message);
            }
            let now = Instant::now();
            self.step(now);
            wait = self.due(now);
        }
        self.close();
    }

    fn take(&mut self, message: Message<W::Order>) {
        match message {
            Message::Order(order) => {
                self.work.take(order);
                self.is_fed = false;
            }
            Message::Device(device) if device != self.device => {
                self.device = device;
                self.close();
                self.retry_at = None;
            }
            Message::Device(_) => {}
            Message::Names => {
                let names = self.work.names();
                self.tell(|status| status.names = Some(names));
            }
            Message::Gone(opening, why) if opening == self.openings && self.opened.is_some() => {
                self.close();
                self.tell(|status| status.state = DeviceState::Missing(why));
                // Retry at once: the default device may have changed.
                self.retry_at = None;
            }
            Message::Gone(..) | Message::End => {}
        }
    }

    /// Opens and closes the device as needed, and passes on changes.
    fn step(&mut self, now: Instant) {
        if self.work.needs_device() {
            self.idle_since = None;
            if self.opened.is_none() && self.retry_at.is_none_or(|at| now >= at) {
                self.open(now);
            }
        } else {
            self.retry_at = None;
            let since = *self.idle_since.get_or_insert(now);
            let is_over = !self.work.lingers() || now.saturating_duration_since(since) >= IDLE;
            if self.opened.is_none() || is_over {
                self.close();
                self.tell(|status| status.state = DeviceState::Closed);
            }
        }
        if self.opened.is_some() && !self.is_fed {
            self.is_fed = self.work.feed();
        }
    }

    /// Returns how long the next step can wait if no message arrives.
    fn due(&self, now: Instant) -> Option<Duration> {
        let retry = self.retry_at.filter(|_| self.opened.is_none());
        let idle = self.idle_since.filter(|_| self.opened.is_some()).map(|since| since + IDLE);
        let again = (self.opened.is_some() && !self.is_fed).then_some(now + AGAIN);
        let next = [retry, idle, again].into_iter().flatten().min()?;
        Some(next.saturating_duration_since(now) + Duration::from_millis(1))
    }

    fn open(&mut self, now: Instant) {
        self.openings += 1;
        let (to, opening) = (self.to.clone(), self.openings);
        let (to, underruns) = (Mutex::new(to), self.underruns.clone());
        let gone = move |why| {
            let _ = to.lock().unwrap_or_else(PoisonError::into_inner).send(Message::Gone(opening, why));
        };
        match self.work.open(self.device.as_deref(), Events { underruns, gone: Arc::new(gone) }) {
            Ok(opened) => {
                let state = DeviceState::Open { name: opened.name.clone(), rate: opened.format.rate };
                (self.opened, self.retry_at, self.is_fed) = (Some(opened), None, false);
                self.tell(|status| status.state = state);
            }
            Err(error) => {
                self.retry_at = Some(now + RETRY);
                self.tell(|status| status.state = DeviceState::Missing(error.to_string()));
            }
        }
    }

    fn close(&mut self) {
        if self.opened.take().is_some() {
            self.work.closed();
        }
    }

    fn tell(&self, change: impl FnOnce(&mut Status)) {
        let mut status = self.status.lock().unwrap_or_else(PoisonError::into_inner);
        let before = (status.state.clone(), status.names.clone());
        change(&mut status);
        let is_news = before != (status.state.clone(), status.names.clone());
        drop(status);
        if is_news {
            (self.wake)();
        }
    }
}
