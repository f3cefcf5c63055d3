//! The signals by which a system ends programs: SIGTERM at logout or shutdown, SIGHUP when the terminal closes, SIGINT by
//! Ctrl+C there. The window closes as by its button, but without a question.

use super::app_event::AppEvent;
use winit::event_loop::EventLoopProxy;

/// Sends [`AppEvent::Terminate`] on the first such signal. The second one ends the process at once.
#[cfg(unix)]
pub(super) fn watch(proxy: EventLoopProxy<AppEvent>) {
    use signal_hook::{
        consts::{SIGHUP, SIGINT, SIGTERM},
        iterator::Signals,
        low_level::emulate_default_handler,
    };
    let mut signals = match Signals::new([SIGHUP, SIGINT, SIGTERM]) {
        Ok(signals) => signals,
        Err(error) => return log::warn!("signals end Eddy at once: {error}"),
    };
    let wait = move || {
        let mut is_first = true;
        for signal in signals.forever() {
            if std::mem::take(&mut is_first) && proxy.send_event(AppEvent::Terminate).is_ok() {
                continue;
            }
            let _ = emulate_default_handler(signal);
        }
    };
    if let Err(error) = std::thread::Builder::new().name("signals".into()).spawn(wait) {
        log::warn!("no thread for signals: {error}");
    }
}

/// Windows closes windows by a message before it ends their programs.
#[cfg(not(unix))]
pub(super) fn watch(_: EventLoopProxy<AppEvent>) {}
