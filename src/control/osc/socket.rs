//! The socket that receives packets, on a separate thread.

use super::decode;
use crate::{ControlQueue, Wake};
use eddy_project::limits;
use std::{
    io::ErrorKind,
    net::{SocketAddr, UdpSocket},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    thread::JoinHandle,
    time::{Duration, Instant},
};

/// The receive timeout: the longest time until the thread notices that it should end.
const PATIENCE: Duration = Duration::from_millis(100);
/// The time between two attempts to bind a port that another program uses.
const RETRY: Duration = Duration::from_secs(3);

/// The state of the socket.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum OscState {
    /// The port is not bound yet.
    #[default]
    Starting,
    /// It listens at this address, with the port that the system chose if port 0 was requested.
    Listening(SocketAddr),
    /// It cannot listen; contains the reason as shown to users. Binding is retried.
    Missing(String),
}

/// Listens until it is dropped.
pub struct OscInput {
    asked: SocketAddr,
    state: Arc<Mutex<OscState>>,
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl OscInput {
    /// Listens at an address. `wake` is called when the state has changed; events go into `queue`, which wakes its
    /// reader itself.
    pub fn listen(address: SocketAddr, queue: ControlQueue, wake: Wake) -> std::io::Result<Self> {
        let state = Arc::new(Mutex::new(OscState::Starting));
        let is_over = Arc::new(AtomicBool::new(false));
        let worker = Worker { address, queue, wake, state: state.clone(), is_over: is_over.clone() };
        let thread = std::thread::Builder::new().name("osc".into()).spawn(move || worker.run())?;
        Ok(Self { asked: address, state, is_over, thread: Some(thread) })
    }

    /// Returns the requested address.
    pub fn asked(&self) -> SocketAddr {
        self.asked
    }

    /// Returns the current state; a change of it calls `wake`.
    pub fn state(&self) -> OscState {
        self.state.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

impl Drop for OscInput {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // If it panicked, there is nothing to report.
            let _ = thread.join();
        }
    }
}

struct Worker {
    address: SocketAddr,
    queue: ControlQueue,
    wake: Wake,
    state: Arc<Mutex<OscState>>,
    is_over: Arc<AtomicBool>,
}

impl Worker {
    fn run(&self) {
        while !self.is_over() {
            let listened = self.bind().and_then(|socket| self.listen(&socket));
            if let Err(error) = listened {
                let why = match error.kind() {
                    ErrorKind::AddrInUse => "another program listens there".to_owned(),
                    ErrorKind::AddrNotAvailable => "this machine does not have that address".to_owned(),
                    ErrorKind::PermissionDenied => {
                        "the system does not allow it; ports from 1024 on are free".to_owned()
                    }
                    _ => error.to_string(),
                };
                self.tell(OscState::Missing(why));
                self.pause();
            }
        }
    }

    fn is_over(&self) -> bool {
        self.is_over.load(Ordering::Relaxed)
    }

    fn bind(&self) -> std::io::Result<UdpSocket> {
        let socket = UdpSocket::bind(self.address)?;
        socket.set_read_timeout(Some(PATIENCE))?;
        self.tell(OscState::Listening(socket.local_addr()?));
        Ok(socket)
    }

    fn listen(&self, socket: &UdpSocket) -> std::io::Result<()> {
        // With one byte more than the limit, an oversized packet is recognised.
        let mut buffer = vec![0; limits::OSC_PACKET.bytes as usize + 1];
        while !self.is_over() {
            match socket.recv_from(&mut buffer) {
                // A damaged packet is the sender's fault, and there may be thousands of them: they are not reported.
                Ok((size, _)) => self.queue.push(decode(&buffer[..size]).unwrap_or_default()),
                // The last two: an earlier reply of ours was refused, or a packet was larger than the buffer (Windows).
                Err(error)
                    if matches!(
                        error.kind(),
                        ErrorKind::WouldBlock
                            | ErrorKind::TimedOut
                            | ErrorKind::Interrupted
                            | ErrorKind::ConnectionReset
                            | ErrorKind::InvalidInput
                    ) => {}
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    fn pause(&self) {
        let end = Instant::now() + RETRY;
        while !self.is_over() && Instant::now() < end {
            std::thread::sleep(PATIENCE);
        }
    }

    fn tell(&self, state: OscState) {
        let mut known = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if *known != state {
            *known = state;
            drop(known);
            (self.wake)();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ControlEvent;
    use eddy_project::ControlAddress;

    fn until<T>(what: &str, get: impl Fn() -> Option<T>) -> T {
        let end = Instant::now() + Duration::from_secs(20);
        loop {
            if let Some(found) = get() {
                return found;
            }
            assert!(Instant::now() < end, "never {what}");
            std::thread::sleep(Duration::from_millis(5));
        }
    }

    fn listening(input: &OscInput) -> SocketAddr {
        until("listening", || match input.state() {
            OscState::Listening(address) => Some(address),
            _ => None,
        })
    }

    /// Sends through a real socket of the loopback interface, with damaged packets among valid ones.
    #[test]
    fn packets_from_the_loopback_interface_arrive_in_the_queue() {
        let queue = ControlQueue::new(Arc::new(|| {}));
        let free = SocketAddr::from(([127, 0, 0, 1], 0));
        let input = OscInput::listen(free, queue.clone(), Arc::new(|| {})).unwrap();
        let address = listening(&input);
        let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
        let rest = b"/1/fader1\0\0\0,f\0\0\x3f\0\0\0";
        for packet in [&b"/1/fader1\0\0\0,f\0\0\x3f"[..], b"", b"nonsense", rest] {
            sender.send_to(packet, address).unwrap();
        }
        let taken = until("an event", || Some(queue.take()).filter(|events| !events.is_empty()));
        let source = ControlAddress::Osc { path: "/1/fader1".into(), argument: 0 };
        assert_eq!(taken, [ControlEvent { source, value: 0.5 }]);
    }

    #[test]
    fn a_port_in_use_is_reported_and_bound_once_it_is_free() {
        let taken = UdpSocket::bind("127.0.0.1:0").unwrap();
        let address = taken.local_addr().unwrap();
        let queue = ControlQueue::new(Arc::new(|| {}));
        let input = OscInput::listen(address, queue, Arc::new(|| {})).unwrap();
        until("a message", || {
            Some(()).filter(|()| input.state() == OscState::Missing("another program listens there".into()))
        });
        drop(taken);
        assert_eq!(listening(&input), address);
    }
}
