//! The selected MIDI devices: opened when they are plugged in, and reopened when they have vanished.

use super::{
    MidiDecoder,
    host::{MidiError, MidiHost, MidiIn, Opened},
};
use crate::{ControlQueue, Wake};
use eddy_project::limits;
use std::{
    collections::BTreeMap,
    sync::{
        Arc, Mutex, PoisonError,
        mpsc::{Receiver, RecvTimeoutError, Sender, channel},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// The interval at which the list of devices is polled.
const LOOK: Duration = Duration::from_secs(2);

/// The selection of devices.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum MidiChoice {
    /// No device is opened.
    #[default]
    Off,
    /// Every connected device, up to [`limits::MIDI_PORTS`].
    All,
    /// The device of this name.
    Named(String),
}

/// The state of the devices.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct MidiState {
    /// The names of the open devices.
    pub open: Vec<String>,
    /// The reason why no device is open, or not the selected one. Devices are polled again.
    pub missing: Option<String>,
    /// All connected devices, as of the last poll; `None` before the first one.
    pub names: Option<Vec<String>>,
}

enum Message {
    Choose(MidiChoice),
    Names,
    End,
}

/// Listens to devices while it is switched on.
pub struct MidiInputs {
    link: Link,
    state: Arc<Mutex<MidiState>>,
}

enum Link {
    Thread {
        to: Sender<Message>,
        thread: Option<JoinHandle<()>>,
    },
    /// Everything runs on the caller's thread: a test controls the time.
    Here(Box<Worker>),
}

impl MidiInputs {
    /// Starts a thread. `wake` is called when the state has changed; events go into `queue`. Nothing is opened yet.
    pub fn on_thread(host: &dyn MidiHost, queue: ControlQueue, wake: Wake) -> std::io::Result<Self> {
        let (to, from) = channel();
        let mut worker = Worker::new(host.input(), queue, wake);
        let state = worker.state.clone();
        let thread = std::thread::Builder::new().name("midi".into()).spawn(move || worker.run(&from))?;
        Ok(Self { link: Link::Thread { to, thread: Some(thread) }, state })
    }

    /// Creates it without a thread: [`MidiInputs::step`] does the work.
    pub fn here(host: &dyn MidiHost, queue: ControlQueue) -> Self {
        let worker = Box::new(Worker::new(host.input(), queue, Arc::new(|| {})));
        let state = worker.state.clone();
        Self { link: Link::Here(worker), state }
    }

    /// Selects the devices to listen to. Those of an earlier selection are closed.
    pub fn choose(&mut self, choice: MidiChoice) {
        self.send(Message::Choose(choice));
    }

    /// Requests the names of the devices, which become part of the state.
    pub fn ask_names(&mut self) {
        self.send(Message::Names);
    }

    /// Returns the state of the devices, as of the last poll.
    pub fn state(&self) -> MidiState {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Does pending work if there is no thread.
    pub fn step(&mut self, now: Instant) {
        if let Link::Here(worker) = &mut self.link {
            worker.step(now);
        }
    }

    fn send(&mut self, message: Message) {
        match &mut self.link {
            // A thread that has panicked receives nothing; drawing continues.
            Link::Thread { to, .. } => drop(to.send(message)),
            Link::Here(worker) => worker.take(message),
        }
    }
}

impl Drop for MidiInputs {
    fn drop(&mut self) {
        self.send(Message::End);
        if let Link::Thread { thread, .. } = &mut self.link
            && let Some(thread) = thread.take()
        {
            let _ = thread.join();
        }
    }
}

struct Worker {
    input: Box<dyn MidiIn>,
    choice: MidiChoice,
    open: BTreeMap<String, Opened>,
    looked_at: Option<Instant>,
    queue: ControlQueue,
    wake: Wake,
    state: Arc<Mutex<MidiState>>,
}

impl Worker {
    fn new(input: Box<dyn MidiIn>, queue: ControlQueue, wake: Wake) -> Self {
        let (choice, open, looked_at) = (MidiChoice::Off, BTreeMap::new(), None);
        Self { input, choice, open, looked_at, queue, wake, state: Arc::default() }
    }

    fn run(&mut self, from: &Receiver<Message>) {
        loop {
            let message = match self.choice {
                MidiChoice::Off => from.recv().map_err(|_| RecvTimeoutError::Disconnected),
                _ => from.recv_timeout(LOOK),
            };
            match message {
                Ok(Message::End) | Err(RecvTimeoutError::Disconnected) => break,
                Ok(message) => self.take(message),
                Err(RecvTimeoutError::Timeout) => {}
            }
            self.step(Instant::now());
        }
        self.open.clear();
    }

    fn take(&mut self, message: Message) {
        match message {
            Message::Choose(choice) if choice != self.choice => {
                self.choice = choice;
                // The previously selected devices are closed, so that other programs can use them.
                self.open.clear();
                self.looked_at = None;
                self.tell(|state| *state = MidiState { names: state.names.take(), ..MidiState::default() });
            }
            Message::Names => {
                let names = self.input.names().unwrap_or_default();
                self.tell(|state| state.names = Some(names));
            }
            Message::Choose(_) | Message::End => {}
        }
    }

    /// Polls the devices, opens the selected ones, and closes those that have vanished.
    fn step(&mut self, now: Instant) {
        let is_due = self.looked_at.is_none_or(|at| now.saturating_duration_since(at) >= LOOK);
        if self.choice == MidiChoice::Off || !is_due {
            return;
        }
        self.looked_at = Some(now);
        let looked = self.input.names();
        let names = looked.as_deref().unwrap_or_default();
        let wanted: Vec<&String> = match &self.choice {
            MidiChoice::Off => Vec::new(),
            MidiChoice::All => names.iter().take(limits::MIDI_PORTS).collect(),
            MidiChoice::Named(name) => names.iter().filter(|known| *known == name).collect(),
        };
        self.open.retain(|name, _| wanted.contains(&name));
        let mut trouble = looked.as_ref().err().cloned();
        for name in wanted {
            if self.open.contains_key(name) {
                continue;
            }
            match self.input.open(name, taker(self.queue.clone())) {
                Ok(opened) => drop(self.open.insert(name.clone(), opened)),
                Err(error) => trouble = Some(error),
            }
        }
        let missing = match (&self.choice, trouble) {
            (_, Some(error)) => Some(error.to_string()),
            (MidiChoice::All, None) if self.open.is_empty() => Some("no MIDI device is connected".to_owned()),
            (MidiChoice::Named(name), None) if self.open.is_empty() => {
                Some(MidiError::Unknown(name.clone()).to_string())
            }
            _ => None,
        };
        let open: Vec<String> = self.open.keys().cloned().collect();
        let names = names.to_vec();
        self.tell(|state| *state = MidiState { open, missing, names: Some(names) });
    }

    fn tell(&self, change: impl FnOnce(&mut MidiState)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let before = state.clone();
        change(&mut state);
        let is_news = before != *state;
        drop(state);
        if is_news {
            (self.wake)();
        }
    }
}

/// Returns a callback that decodes a device's bytes into the queue.
fn taker(queue: ControlQueue) -> super::host::Take {
    let (mut decoder, mut events) = (MidiDecoder::default(), Vec::new());
    Box::new(move |bytes: &[u8]| {
        decoder.feed(bytes, Instant::now(), &mut events);
        queue.push(events.drain(..));
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::FakeMidi;

    #[test]
    fn devices_are_reopened_when_they_are_plugged_in_again() {
        let (host, queue) = (FakeMidi::default(), ControlQueue::new(Arc::new(|| {})));
        let mut inputs = MidiInputs::here(&host, queue.clone());
        let mut now = Instant::now();
        let mut look = |inputs: &mut MidiInputs| {
            now += LOOK;
            inputs.step(now);
            inputs.state()
        };
        host.plug_in("Knobs");
        assert_eq!(look(&mut inputs), MidiState::default(), "nothing is opened before somebody asks");
        inputs.choose(MidiChoice::All);
        assert_eq!(look(&mut inputs).open, ["Knobs"]);
        host.send("Knobs", &[0xb0, 70, 127]);
        assert_eq!(queue.take().len(), 1);
        host.plug_in("Keys");
        assert_eq!(look(&mut inputs).open, ["Keys", "Knobs"]);
        host.unplug("Knobs");
        host.unplug("Keys");
        let state = look(&mut inputs);
        assert_eq!((state.open.len(), state.missing.as_deref()), (0, Some("no MIDI device is connected")));
        host.plug_in("Knobs");
        assert_eq!(
            look(&mut inputs),
            MidiState { open: vec!["Knobs".into()], missing: None, names: Some(vec!["Knobs".into()]) }
        );
        host.send("Knobs", &[0xb0, 70, 0]);
        assert_eq!(queue.take().len(), 1);
        inputs.choose(MidiChoice::Off);
        assert!(!host.is_open("Knobs"));
        host.send("Knobs", &[0xb0, 70, 0]);
        assert_eq!(queue.take(), []);
    }

    #[test]
    fn a_named_device_is_opened_once_it_is_plugged_in() {
        let (host, queue) = (FakeMidi::default(), ControlQueue::new(Arc::new(|| {})));
        host.plug_in("Keys");
        let mut inputs = MidiInputs::here(&host, queue);
        inputs.choose(MidiChoice::Named("Knobs".into()));
        let now = Instant::now();
        inputs.step(now);
        assert_eq!(inputs.state().missing.as_deref(), Some("there is no device \"Knobs\""));
        host.plug_in("Knobs");
        inputs.step(now + LOOK);
        assert_eq!((inputs.state().open, inputs.state().missing), (vec!["Knobs".to_owned()], None));
        assert!(!host.is_open("Keys"));
    }

    #[test]
    fn devices_are_opened_on_a_thread_too() {
        let (host, queue) = (FakeMidi::default(), ControlQueue::new(Arc::new(|| {})));
        host.plug_in("Knobs");
        let mut inputs = MidiInputs::on_thread(&host, queue, Arc::new(|| {})).unwrap();
        inputs.choose(MidiChoice::All);
        let end = Instant::now() + Duration::from_secs(20);
        while inputs.state().open.is_empty() {
            assert!(Instant::now() < end, "{:?}", inputs.state());
            std::thread::sleep(Duration::from_millis(5));
        }
        drop(inputs);
        assert!(!host.is_open("Knobs"));
    }
}
