//! Gamepads, which channels read as a texture.

use super::Controls;
use crate::{
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_control::pads::{PadEvent, PadInputs};
use eddy_media::Gamepads;
use eddy_project::InputKind;

impl Controls {
    pub(crate) fn set_gamepads(&mut self, open: &mut OpenProject, on: bool) {
        if self.pads.is_some() == on {
            return;
        }
        open.dismiss_notices(About::Gamepads);
        self.is_pad_told = false;
        if !on {
            self.pads = None;
            open.playback.gamepads = Gamepads::default();
            return;
        }
        let Some(host) = self.pad_host.clone() else { return };
        match PadInputs::listen(host, self.queue.clone(), open.host.wake.clone()) {
            Ok(pads) => self.pads = Some(pads),
            Err(error) => {
                open.notice_about(About::Gamepads, Level::Warning, format!("no thread for gamepads: {error}"));
            }
        }
    }

    /// Takes new gamepad events.
    pub(super) fn follow_gamepads(&mut self, open: &mut OpenProject) {
        let Some(pads) = &self.pads else { return };
        let events = pads.take();
        if let Some(why) = pads.state().trouble
            && !std::mem::replace(&mut self.is_pad_told, true)
        {
            open.notice_about(About::Gamepads, Level::Warning, format!("gamepads cannot be read: {why}"));
        }
        let mut is_turned = false;
        for event in events {
            match event {
                PadEvent::Connected { pad, name } => {
                    open.playback.gamepads.connect(pad, true);
                    let text = format!("gamepad {} connected: {name}", pad + 1);
                    open.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Disconnected { pad } => {
                    open.playback.gamepads.connect(pad, false);
                    let text = format!("gamepad {} disconnected", pad + 1);
                    open.notice_about(About::Gamepads, Level::Info, text);
                }
                PadEvent::Moved { pad, part, value } => {
                    is_turned |= open.playback.gamepads.move_to(pad, part, value);
                }
            }
        }
        // A button draws a frame while time is paused, as a key does. A stick does not: it is never quite at rest.
        if is_turned && !open.playback.is_replaying() && open.reads_device(InputKind::Gamepad) {
            open.playback.is_frame_due = true;
        }
    }
}
