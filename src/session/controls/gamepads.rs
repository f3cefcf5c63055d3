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
        if self.services.controls.pads.is_some() == on {
            return;
        }
        self.open.settled(About::Gamepads);
        self.services.controls.is_pad_told = false;
        if !on {
            self.services.controls.pads = None;
            self.open.playback.gamepads = Gamepads::default();
            return;
        }
        let Some(host) = self.services.controls.pad_host.clone() else { return };
        match PadInputs::listen(host, self.services.controls.queue.clone(), self.open.host.wake.clone()) {
            Ok(pads) => self.services.controls.pads = Some(pads),
            Err(error) => {
                self.open.notice_about(About::Gamepads, Level::Warning, format!("no thread for gamepads: {error}"));
            }
        }
    }

    /// Takes new gamepad events.
    pub(super) fn follow_gamepads(&mut self) {
        let Some(pads) = &self.services.controls.pads else { return };
        let events = pads.take();
        if let Some(why) = pads.state().trouble
            && !std::mem::replace(&mut self.services.controls.is_pad_told, true)
        {
            self.open.notice_about(About::Gamepads, Level::Warning, format!("gamepads cannot be read: {why}"));
        }
        let mut is_turned = false;
        for event in events {
            match event {
                PadEvent::Connected { pad, name } => {
                    self.open.playback.gamepads.connect(pad, true);
                    let text = format!("gamepad {} connected: {name}", pad + 1);
                    self.open.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Disconnected { pad } => {
                    self.open.playback.gamepads.connect(pad, false);
                    let text = format!("gamepad {} disconnected", pad + 1);
                    self.open.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Moved { pad, part, value } => {
                    is_turned |= self.open.playback.gamepads.move_to(pad, part, value);
                }
            }
        }
        // A button draws a frame while time is paused, as a key does. A stick does not: it is never quite at rest.
        if is_turned && !self.open.playback.is_replaying() && self.reads_device(InputKind::Gamepad) {
            self.open.playback.is_frame_due = true;
        }
    }
}
