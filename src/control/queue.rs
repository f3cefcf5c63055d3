//! Movements of controls between the threads that read devices and the one that draws.

use crate::{ControlEvent, Wake};
use eddy_project::limits;
use std::{
    collections::VecDeque,
    sync::{Arc, Mutex, PoisonError},
};

/// Movements in the order of their arrival, from all devices. When it is full, the oldest are dropped.
#[derive(Clone)]
pub struct ControlQueue {
    waiting: Arc<Mutex<VecDeque<ControlEvent>>>,
    wake: Wake,
}

impl ControlQueue {
    /// `wake` is called from another thread when an event arrives in an empty queue.
    pub fn new(wake: Wake) -> Self {
        Self { waiting: Arc::default(), wake }
    }

    /// Appends movements, at most [`limits::CONTROL_EVENTS`] of which wait, and wakes the reader of an empty queue.
    pub fn push(&self, events: impl IntoIterator<Item = ControlEvent>) {
        let mut waiting = self.waiting.lock().unwrap_or_else(PoisonError::into_inner);
        let was_empty = waiting.is_empty();
        for event in events {
            if waiting.len() == limits::CONTROL_EVENTS {
                waiting.pop_front();
            }
            waiting.push_back(event);
        }
        let is_news = was_empty && !waiting.is_empty();
        drop(waiting);
        if is_news {
            (self.wake)();
        }
    }

    /// Takes all events.
    pub fn take(&self) -> Vec<ControlEvent> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner).drain(..).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::ControlAddress;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn a_full_queue_drops_the_oldest_and_wakes_once() {
        let wakes = Arc::new(AtomicUsize::new(0));
        let count = wakes.clone();
        let queue = ControlQueue::new(Arc::new(move || {
            count.fetch_add(1, Ordering::Relaxed);
        }));
        let event = |n: usize| ControlEvent { source: ControlAddress::PitchBend { channel: 0 }, value: n as f64 };
        (0..limits::CONTROL_EVENTS + 10).for_each(|n| queue.push([event(n)]));
        queue.push([]);
        assert_eq!(wakes.load(Ordering::Relaxed), 1);
        let taken = queue.take();
        assert_eq!((taken.len(), taken[0].value), (limits::CONTROL_EVENTS, 10.0));
        assert_eq!(queue.take(), []);
        queue.push([event(1)]);
        assert_eq!(wakes.load(Ordering::Relaxed), 2);
    }
}
