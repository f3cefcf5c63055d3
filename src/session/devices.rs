//! Cameras and microphones: which kinds of device the user has allowed, and the active camera.
//!
//! A device is used only after the user has turned it on for the open project in this run, and only while a channel reads
//! it. A project that reads one shows black until then, and another project asks again.

use super::{
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_project::{InputKind, Project};
use eddy_video::{Camera, CameraDevice, CameraFrame, CameraSource, Tools, VideoError};

/// The kinds of device that the user has allowed the open project to use.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceConsent {
    allowed: Vec<InputKind>,
}

impl DeviceConsent {
    pub fn allow(&mut self, kind: InputKind) {
        if !self.allows(kind) {
            self.allowed.push(kind);
        }
    }

    pub fn withdraw(&mut self, kind: InputKind) {
        self.allowed.retain(|allowed| *allowed != kind);
    }

    pub fn allows(&self, kind: InputKind) -> bool {
        self.allowed.contains(&kind)
    }
}

/// The state of a device that a project reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraState {
    /// The user has not turned it on.
    Off,
    /// It is on and has delivered nothing yet.
    Starting,
    On,
}

/// The devices of a session.
#[derive(Default)]
pub(super) struct Devices {
    pub consent: DeviceConsent,
    camera: Option<Camera>,
    /// The camera that the user has chosen, if any.
    chosen: Option<CameraSource>,
    /// The machine's cameras, as found when a camera was last turned on.
    found: Vec<CameraDevice>,
    /// The program shows the camera's pictures.
    is_shown: bool,
    /// The user was told that it has stopped.
    is_end_told: bool,
}

impl Devices {
    pub(crate) fn camera(&self) -> Option<&Camera> {
        self.camera.as_ref().filter(|camera| camera.newest().is_some())
    }

    /// Turns the camera off at once, also for programs that still draw its pictures. Returns whether one was on.
    fn turn_camera_off(&mut self) -> bool {
        let camera = self.camera.take();
        camera.iter().for_each(Camera::turn_off);
        camera.is_some()
    }

    /// Turns everything off: another project has to ask again.
    /// The devices of another project, which are all off. The cameras that were found are known to it.
    pub(crate) fn successor(&mut self) -> Self {
        self.turn_camera_off();
        Devices { chosen: self.chosen.take(), found: std::mem::take(&mut self.found), ..Devices::default() }
    }
}

impl OpenProject {
    /// Returns the available cameras, known once one has been on, and the active one.
    pub(crate) fn cameras(&self) -> (&[CameraDevice], Option<&CameraSource>) {
        (&self.devices.found, self.devices.camera.as_ref().map(Camera::source))
    }

    /// Returns the newest picture of the active camera.
    pub(crate) fn camera_picture(&self) -> Option<CameraFrame> {
        self.devices.camera.as_ref().and_then(Camera::newest)
    }

    pub(crate) fn device_state(&self, kind: InputKind) -> CameraState {
        match (&self.devices.camera, kind) {
            (Some(camera), InputKind::Webcam) if camera.newest().is_some() => CameraState::On,
            (Some(_), InputKind::Webcam) => CameraState::Starting,
            _ => CameraState::Off,
        }
    }

    /// Returns whether a channel of a drawn pass reads a kind of device.
    pub(crate) fn reads_device(&self, kind: InputKind) -> bool {
        reads(self.project(), kind)
    }

    /// Turns a device on or off, at the user's request.
    pub(super) fn use_device(&mut self, kind: InputKind, on: bool) {
        if kind != InputKind::Webcam {
            return;
        }
        self.dismiss_notices(About::Device);
        if !on {
            self.devices.consent.withdraw(kind);
            if self.devices.turn_camera_off() {
                self.compile_soon();
            }
            return;
        }
        self.devices.consent.allow(kind);
        self.open_camera();
    }

    /// Chooses a camera and turns it on, at the user's request.
    pub(super) fn choose_camera(&mut self, id: String) {
        self.devices.chosen = Some(CameraSource::Device(id));
        self.devices.turn_camera_off();
        self.use_device(InputKind::Webcam, true);
    }

    /// Opens the camera if the user has allowed it and a channel reads it.
    fn open_camera(&mut self) {
        let is_allowed = self.devices.consent.allows(InputKind::Webcam);
        if self.devices.camera.is_some() || !is_allowed || !self.reads_device(InputKind::Webcam) {
            return;
        }
        let wake = self.host.wake.clone();
        let source = self.devices.chosen.clone().unwrap_or_else(|| self.host.options.camera.clone());
        self.devices.camera = Some(Camera::open(source, &Tools::default(), move || wake()));
        (self.devices.is_shown, self.devices.is_end_told) = (false, false);
    }

    /// Turns the camera off with the last channel that reads it, and on again with the next one: the user has allowed
    /// it for this project. Shows a camera that has started, and reports one that has stopped.
    pub(super) fn follow_devices(&mut self) {
        if !self.reads_device(InputKind::Webcam) {
            if self.devices.turn_camera_off() {
                self.dismiss_notices(About::Device);
                self.host.changed = true;
            }
            return;
        }
        self.open_camera();
        let Some(camera) = &self.devices.camera else { return };
        if camera.newest().is_some() && !std::mem::replace(&mut self.devices.is_shown, true) {
            self.devices.found = camera.found();
            self.host.changed = true;
            self.compile_soon();
            return;
        }
        let Some(error) = camera.error().filter(|_| !self.devices.is_end_told) else { return };
        let has_picture = camera.newest().is_some();
        let text = match (&error, has_picture) {
            (VideoError::Camera(why), true) => format!("the camera stopped ({why}); its last picture stays"),
            (_, true) => format!("the camera stopped: {error}; its last picture stays"),
            (_, false) => format!("{error}; {}", error.hint()),
        };
        self.devices.is_end_told = true;
        self.notice_about(About::Device, Level::Warning, text);
        if !has_picture {
            self.devices.camera = None;
            self.devices.consent.withdraw(InputKind::Webcam);
            self.host.changed = true;
        }
    }
}

fn reads(project: &Project, kind: InputKind) -> bool {
    let passes = project.passes.iter().filter(|pass| pass.id.is_picture());
    passes.flat_map(|pass| pass.bindings.channels()).any(|channel| channel.input.kind() == kind)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn consent_is_given_for_one_kind_and_can_be_withdrawn() {
        let mut consent = DeviceConsent::default();
        assert!(!consent.allows(InputKind::Webcam));
        consent.allow(InputKind::Webcam);
        consent.allow(InputKind::Webcam);
        assert!(consent.allows(InputKind::Webcam) && !consent.allows(InputKind::Microphone));
        consent.withdraw(InputKind::Webcam);
        assert_eq!(consent, DeviceConsent::default());
    }
}
