//! Gamepads, which channels read as a texture.

use crate::{
    Session,
    view::{About, Level},
};
use eddy_control::pads::{PadEvent, PadInputs};
use eddy_media::Gamepads;
use eddy_project::InputKind;

impl Session {
    pub(crate) fn set_gamepads(&mut self, on: bool) {
        if self.controls.pads.is_some() == on {
            return;
        }
        self.settled(About::Gamepads);
        self.controls.is_pad_told = false;
        if !on {
            self.controls.pads = None;
            self.playback.gamepads = Gamepads::default();
            return;
        }
        let Some(host) = self.controls.pad_host.clone() else { return };
        match PadInputs::listen(host, self.controls.queue.clone(), self.wake.clone()) {
            Ok(pads) => self.controls.pads = Some(pads),
            Err(error) => {
                self.notice_about(About::Gamepads, Level::Warning, format!("no thread for gamepads: {error}"));
            }
        }
    }

    /// Takes new gamepad events.
    pub(super) fn follow_gamepads(&mut self) {
        let Some(pads) = &self.controls.pads else { return };
        let events = pads.take();
        if let Some(why) = pads.state().trouble
            && !std::mem::replace(&mut self.controls.is_pad_told, true)
        {
            self.notice_about(About::Gamepads, Level::Warning, format!("gamepads cannot be read: {why}"));
        }
        let mut is_turned = false;
        for event in events {
            match event {
                PadEvent::Connected { pad, name } => {
                    self.playback.gamepads.connect(pad, true);
                    let text = format!("gamepad {} connected: {name}", pad + 1);
                    self.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Disconnected { pad } => {
                    self.playback.gamepads.connect(pad, false);
                    let text = format!("gamepad {} disconnected", pad + 1);
                    self.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Moved { pad, part, value } => {
                    is_turned |= self.playback.gamepads.move_to(pad, part, value);
                }
            }
        }
        // A button draws a frame while time is paused, as a key does. A stick does not: it is never quite at rest.
        if is_turned && !self.playback.is_replaying() && self.reads_device(InputKind::Gamepad) {
            self.playback.is_frame_due = true;
        }
    }
}
