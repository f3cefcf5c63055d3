//! The thread that reads gamepads while they are switched on.

use super::{PadEvent, PadHost};
use crate::{ControlEvent, ControlQueue, Wake};
use eddy_project::{ControlAddress, PADS, limits};
use std::{
    collections::{BTreeMap, VecDeque},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread::JoinHandle,
    time::Duration,
};

/// The poll timeout: the longest time until the thread notices that it should end.
const PATIENCE: Duration = Duration::from_millis(100);

/// The state of the gamepads.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PadState {
    /// The names of the connected gamepads, by number.
    pub connected: BTreeMap<usize, String>,
    /// The reason why gamepads cannot be read.
    pub trouble: Option<String>,
}

#[derive(Default)]
struct Shared {
    state: PadState,
    /// Events that have not been taken yet.
    waiting: VecDeque<PadEvent>,
}

/// Reads gamepads until it is dropped.
pub struct PadInputs {
    shared: Arc<Mutex<Shared>>,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl PadInputs {
    /// Starts the thread. `wake` is called after each event. Movements also go into `queue`, as those of other
    /// controls.
    pub fn listen(host: Arc<dyn PadHost>, queue: ControlQueue, wake: Wake) -> std::io::Result<Self> {
        let shared: Arc<Mutex<Shared>> = Arc::default();
        let is_over = Arc::new(AtomicBool::new(false));
        let worker = Worker { queue, wake, shared: shared.clone(), is_over: is_over.clone() };
        let thread = std::thread::Builder::new().name("gamepads".into()).spawn(move || worker.run(&*host))?;
        Ok(Self { shared, is_over, thread: Some(thread) })
    }

    /// Returns the connected gamepads, or the reason why none can be read.
    pub fn state(&self) -> PadState {
        lock(&self.shared).state.clone()
    }

    /// Takes the events since the last call, in order.
    pub fn take(&self) -> Vec<PadEvent> {
        lock(&self.shared).waiting.drain(..).collect()
    }
}

impl Drop for PadInputs {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

fn lock(shared: &Mutex<Shared>) -> std::sync::MutexGuard<'_, Shared> {
    shared.lock().unwrap_or_else(PoisonError::into_inner)
}

struct Worker {
    queue: ControlQueue,
    wake: Wake,
    shared: Arc<Mutex<Shared>>,
    is_over: Arc<AtomicBool>,
}

impl Worker {
    fn run(&self, host: &dyn PadHost) {
        let mut pads = match host.open() {
            Ok(pads) => pads,
            Err(why) => {
                lock(&self.shared).state.trouble = Some(why);
                return (self.wake)();
            }
        };
        while !self.is_over.load(Ordering::Relaxed) {
            if let Some(event) = pads.next(PATIENCE) {
                self.note(event);
            }
        }
    }

    fn note(&self, event: PadEvent) {
        let mut shared = lock(&self.shared);
        match &event {
            PadEvent::Connected { pad, name } if *pad < PADS => {
                shared.state.connected.insert(*pad, name.clone());
            }
            PadEvent::Disconnected { pad } => drop(shared.state.connected.remove(pad)),
            PadEvent::Connected { .. } | PadEvent::Moved { .. } => {}
        }
        let moved = match &event {
            PadEvent::Moved { pad, part, value } if *pad < PADS && value.is_finite() => {
                let source = ControlAddress::Pad { pad: *pad as u8, part: *part };
                Some(ControlEvent { source, value: part.part_of_way(*value).clamp(0.0, 1.0) })
            }
            _ => None,
        };
        if shared.waiting.len() == limits::CONTROL_EVENTS {
            shared.waiting.pop_front();
        }
        shared.waiting.push_back(event);
        drop(shared);
        self.queue.push(moved);
        (self.wake)();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fake::FakePads;
    use eddy_project::PadPart;
    use std::time::Instant;

    #[test]
    fn gamepad_events_are_taken_in_order_and_move_controls() {
        let (host, queue) = (FakePads::default(), ControlQueue::new(Arc::new(|| {})));
        let events = [
            PadEvent::Connected { pad: 0, name: "Pad".into() },
            PadEvent::Moved { pad: 0, part: PadPart::Axis(1), value: -0.5 },
            PadEvent::Moved { pad: 9, part: PadPart::Axis(1), value: -0.5 },
            PadEvent::Disconnected { pad: 0 },
        ];
        events.iter().for_each(|event| host.happens(event.clone()));
        let inputs = PadInputs::listen(Arc::new(host.clone()), queue.clone(), Arc::new(|| {})).unwrap();
        let (mut taken, end) = (Vec::new(), Instant::now() + Duration::from_secs(20));
        while taken.len() < events.len() {
            assert!(Instant::now() < end, "{taken:?}");
            taken.extend(inputs.take());
            std::thread::sleep(Duration::from_millis(2));
        }
        assert_eq!(taken, events);
        let source = ControlAddress::Pad { pad: 0, part: PadPart::Axis(1) };
        assert_eq!((queue.take(), inputs.state()), (vec![ControlEvent { source, value: 0.25 }], PadState::default()));
    }
}
