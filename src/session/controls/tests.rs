//! Tests of a session whose uniforms are moved by simulated MIDI devices and real UDP packets.

use super::*;
use crate::Session;
use crate::{ControlCommand, EditCommand, FileCommand, SessionOptions, TransportCommand};
use eddy_control::{
    fake::{FakeMidi, FakePads},
    pads::PadEvent,
};
use eddy_gpu::testing;
use eddy_project::Project;
use std::net::UdpSocket;

const TEXT: &str = "#iUniform float speed = 1.0 in { 0.0, 4.0 }\n#iUniform vec2 center in { -1.0, 1.0 }\n\
                    #iUniform bool on\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(speed, center, on ? 1.0 : 0.0); }\n";

struct Fixture {
    session: Session,
    midi: FakeMidi,
    pads: FakePads,
    now: Instant,
}

impl Fixture {
    fn open() -> Option<Fixture> {
        Self::with(TEXT)
    }

    fn with(text: &str) -> Option<Fixture> {
        let gpu = testing::gpu()?;
        let midi = FakeMidi::default();
        midi.plug_in("Knobs");
        let host: Arc<dyn MidiHost> = Arc::new(midi.clone());
        let pads = FakePads::default();
        let options = SessionOptions {
            midi: Some(host),
            gamepads: Some(Arc::new(pads.clone())),
            audio_on_thread: false,
            ..SessionOptions::default()
        };
        let mut session = Session::with_options(gpu, Arc::new(|| ()), options).unwrap();
        let mut project = Project::of_image("p".into(), text.into());
        eddy_project::declare_channels(&mut project);
        session.apply(FileCommand::OpenProject { project: Box::new(project), size: None });
        session.apply(TransportCommand::Pause);
        session.apply(ControlCommand::SetMidi(MidiChoice::All));
        let mut room = Fixture { session, midi, pads, now: Instant::now() };
        room.until("a program", |session| session.open.engine.has_program());
        Some(room)
    }

    fn tick(&mut self) {
        self.now += Duration::from_millis(16);
        self.session.tick(self.now);
    }

    fn until(&mut self, what: &str, is_so: impl Fn(&Session) -> bool) {
        let end = Instant::now() + Duration::from_secs(60);
        while !is_so(&self.session) {
            assert!(Instant::now() < end, "never {what}: {:?}", self.session.notices());
            self.tick();
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    fn send(&mut self, bytes: &[u8]) {
        self.midi.send("Knobs", bytes);
        self.tick();
    }

    fn learn(&mut self, target: &ControlTarget, bytes: &[u8]) {
        self.session.apply(ControlCommand::LearnControl(Some(target.clone())));
        assert!(self.session.is_learning(target));
        self.send(bytes);
        assert!(!self.session.is_learning(target));
    }

    fn value(&self, name: &str) -> Vec<f64> {
        let uniform = self.session.custom_uniforms().iter().find(|uniform| uniform.name == name).unwrap();
        self.session.custom_uniform_value(uniform).components()
    }

    fn bound(&self, target: &ControlTarget) -> Option<String> {
        self.session.control_of(target).map(ToString::to_string)
    }
}

/// Returns the value of a uniform that is set to `x`.
fn short(x: f64) -> f64 {
    eddy_project::CustomUniformValue::Float(x).shortest().components()[0]
}

#[test]
fn control_can_be_learned_moved_and_forgotten() {
    let Some(mut room) = Fixture::open() else { return };
    let speed = ControlTarget::whole("speed");
    room.send(&[0xb0, 70, 127]);
    assert_eq!((room.value("speed"), room.session.is_dirty()), (vec![1.0], false), "nobody has learned it");
    room.learn(&speed, &[0xb0, 70, 127]);
    assert_eq!((room.bound(&speed).as_deref(), room.value("speed")), (Some("midi 1 cc 70"), vec![4.0]));
    assert!(room.session.is_dirty() && room.session.unsaved_parts().contains(&"controls of uniforms".to_owned()));
    room.send(&[0xb0, 70, 0]);
    assert_eq!(room.value("speed"), [0.0]);
    room.send(&[0xb0, 71, 127]);
    assert_eq!(room.value("speed"), [0.0], "another knob");
    // One movement of several controls is one undo step.
    let y = ControlTarget::of_component("center", "y").unwrap();
    room.learn(&y, &[0xe0, 0, 64]);
    for n in 1..=40 {
        room.send(&[0xb0, 70, n, 0xe0, 0, 64 + n]);
    }
    let (moved, steps) = (room.value("center"), room.session.open.pass_history.undo.len());
    assert!(moved[1] > 0.5 && steps == 1, "{moved:?} in {steps} steps");
    assert_eq!(room.session.pass_undo().unwrap().title, "change center and speed");
    room.session.apply(EditCommand::UndoPassEdit);
    assert_eq!((room.value("speed"), room.value("center")), (vec![1.0], vec![-1.0, -1.0]));
    room.session.apply(EditCommand::RedoPassEdit);
    assert_eq!(room.value("center"), moved);
    room.session.apply(ControlCommand::ForgetControl(speed.clone()));
    let before = room.value("speed");
    room.send(&[0xb0, 70, 127]);
    assert_eq!((room.bound(&speed), room.value("speed")), (None, before));
}

#[test]
fn fourteen_bit_control_is_learned_as_one_and_key_toggles() {
    let Some(mut room) = Fixture::open() else { return };
    let (speed, on) = (ControlTarget::whole("speed"), ControlTarget::whole("on"));
    // Both parts at once, and one after the other.
    room.learn(&speed, &[0xb0, 7, 64, 0xb0, 39, 1]);
    assert_eq!(room.bound(&speed).as_deref(), Some("midi 1 cc14 7"));
    room.session.apply(ControlCommand::ForgetControl(speed.clone()));
    room.learn(&speed, &[0xb1, 7, 64]);
    assert_eq!(room.bound(&speed).as_deref(), Some("midi 2 cc 7"));
    room.send(&[0xb1, 39, 1]);
    assert_eq!(room.bound(&speed).as_deref(), Some("midi 2 cc14 7"));
    room.send(&[0xb1, 7, 127, 39, 126]);
    let fine = room.value("speed")[0];
    assert!(fine < 4.0 && fine > 3.999, "{fine}");
    room.learn(&on, &[0x80, 60, 0, 0x90, 60, 100]);
    assert_eq!((room.bound(&on).as_deref(), room.value("on")), (Some("midi 1 note 60"), vec![1.0]));
    room.send(&[0x80, 60, 0]);
    assert_eq!(room.value("on"), [1.0], "a key that is released changes nothing");
    room.send(&[0x90, 60, 1, 0x90, 60, 0, 0x90, 60, 1]);
    assert_eq!(room.value("on"), [1.0], "twice within a frame");
    room.send(&[0x90, 60, 1]);
    assert_eq!(room.value("on"), [0.0]);
}

#[test]
fn knob_waits_for_pickup_at_the_value() {
    let Some(mut room) = Fixture::open() else { return };
    let speed = ControlTarget::whole("speed");
    room.learn(&speed, &[0xb0, 70, 127]);
    assert_eq!((room.value("speed"), room.session.control_waits(&speed)), (vec![4.0], None), "it was just learned");
    // A slider moves the value away from the knob.
    let value = eddy_project::CustomUniformValue::Float(1.0);
    room.session.apply(EditCommand::SetCustomUniform { name: "speed".into(), value: Some(value) });
    room.send(&[0xb0, 70, 120]);
    assert_eq!((room.value("speed"), room.session.control_waits(&speed)), (vec![1.0], Some(PickupSide::Above)));
    room.send(&[0xb0, 70, 40]);
    assert_eq!(room.value("speed"), [1.0]);
    room.send(&[0xb0, 70, 20]);
    assert_eq!((room.value("speed"), room.session.control_waits(&speed)), (vec![short(4.0 * 20.0 / 127.0)], None));
    // The same for a project that has the control and another value.
    let mut project = room.session.project().clone();
    project.custom_uniform_values.insert("speed".into(), eddy_project::CustomUniformValue::Float(3.0));
    room.session.apply(FileCommand::OpenProject { project: Box::new(project), size: None });
    room.session.apply(FileCommand::Answer(crate::Answer::Discard));
    room.until("a program", |session| session.open.engine.has_program() && !session.custom_uniforms().is_empty());
    room.send(&[0xb0, 70, 21]);
    assert_eq!((room.value("speed"), room.session.control_waits(&speed)), (vec![3.0], Some(PickupSide::Below)));
    room.session.apply(ControlCommand::ForgetControl(speed.clone()));
    assert_eq!(room.session.control_waits(&speed), None);
    // A switch and a pitch bend have no value to reach first.
    room.learn(&ControlTarget::whole("on"), &[0xb0, 71, 127]);
    room.send(&[0xb0, 71, 0]);
    assert_eq!(room.value("on"), [0.0]);
}

#[test]
fn parameter_number_is_learned_in_any_message_order() {
    let Some(mut room) = Fixture::open() else { return };
    let speed = ControlTarget::whole("speed");
    room.learn(&speed, &[0xb0, 99, 2, 98, 44, 6, 64]);
    assert_eq!(room.bound(&speed).as_deref(), Some("midi 1 nrpn 300"));
    room.send(&[0xb0, 99, 2, 98, 44, 6, 127]);
    assert_eq!(room.value("speed"), [4.0]);
    room.session.apply(ControlCommand::ForgetControl(speed.clone()));
    room.learn(&speed, &[0xb1, 99, 0]);
    room.send(&[0xb1, 98, 5]);
    room.send(&[0xb1, 6, 127]);
    assert_eq!(room.bound(&speed).as_deref(), Some("midi 2 nrpn 5"));
}

#[test]
fn osc_moves_named_and_learned_uniforms() {
    let Some(mut room) = Fixture::open() else { return };
    room.session.apply(ControlCommand::SetOsc(Some(SocketAddr::from(([127, 0, 0, 1], 0)))));
    room.until("listening", |session| matches!(session.controls_view().osc, Some(OscState::Listening(_))));
    let Some(OscState::Listening(to)) = room.session.controls_view().osc else { unreachable!() };
    let sender = UdpSocket::bind("127.0.0.1:0").unwrap();
    let send = |packet: &[u8]| {
        sender.send_to(packet, to).unwrap();
    };
    send(b"/eddy/speed\0,f\0\0\x40\x20\0\0");
    room.until("the value", |session| session.project().custom_uniform_values.contains_key("speed"));
    assert_eq!(room.value("speed"), [2.5]);
    send(b"/eddy/center\0\0\0\0,ff\0\x3f\0\0\0\xbf\0\0\0");
    room.until("the value", |session| session.project().custom_uniform_values.contains_key("center"));
    assert_eq!(room.value("center"), [0.5, -0.5]);
    // A pattern moves everything that it matches and cannot be learned itself.
    send(b"/eddy/{speed,center}\0\0\0\0,ff\0\x3f\x80\0\0\x3e\x80\0\0");
    room.until("the values", |session| {
        session.project().custom_uniform_values.get("center").is_some_and(|v| v.components() == [1.0, 0.25])
    });
    assert_eq!(room.value("speed"), [1.0]);
    send(b"/eddy/center\0\0\0\0,ff\0\x3f\0\0\0\xbf\0\0\0");
    // The second number of a pad is bound to the second component; the touch message is not learned.
    let y = ControlTarget::of_component("center", "y").unwrap();
    room.session.apply(ControlCommand::LearnControl(Some(y.clone())));
    send(b"/eddy/speed\0,f\0\0\x40\x20\0\0");
    send(b"/1/x*\0\0\0,ff\0\x3f\0\0\0\x3f\x80\0\0");
    send(b"/1/xy/z\0,f\0\0\x3f\x80\0\0");
    send(b"/1/xy\0\0\0,ff\0\x3f\0\0\0\x3f\x80\0\0");
    room.until("a control", |session| session.control_of(&y).is_some());
    assert_eq!((room.bound(&y).as_deref(), room.value("center")), (Some("/1/xy 2"), vec![0.5, 1.0]));
    assert!(!room.session.controls_view().is_osc_public);
    room.session.apply(ControlCommand::SetOsc(None));
    assert_eq!(room.session.controls_view().osc, None);
    assert_eq!(UdpSocket::bind(to).map(|_| ()).map_err(|e| e.kind()), Ok(()), "the port is free again");
}

#[test]
fn connected_and_removed_devices_are_reported_once() {
    let Some(mut room) = Fixture::open() else { return };
    let told = |room: &Fixture, text: &str| room.session.notices().iter().filter(|n| n.text.contains(text)).count();
    assert_eq!(told(&room, "MIDI device connected: Knobs"), 1);
    room.midi.unplug("Knobs");
    room.now += Duration::from_secs(3);
    (0..300).for_each(|_| room.tick());
    assert_eq!((told(&room, "disconnected: Knobs"), told(&room, "no MIDI device is connected")), (1, 1));
    room.midi.plug_in("Knobs");
    room.now += Duration::from_secs(3);
    room.tick();
    assert_eq!((told(&room, "connected: Knobs"), told(&room, "no MIDI device is connected")), (3, 0));
}

/// A recording contains values set by controls like those set by hand.
#[test]
fn recording_contains_values_set_by_controls() {
    let Some(mut room) = Fixture::open() else { return };
    room.learn(&ControlTarget::whole("speed"), &[0xb0, 70, 0]);
    room.session.apply(TransportCommand::Record);
    room.session.apply(TransportCommand::Play);
    for n in [0, 32, 64, 127] {
        room.send(&[0xb0, 70, n]);
        (0..3).for_each(|_| room.tick());
    }
    let frames = &room.session.open.playback.recorder.as_ref().unwrap().recording.frames;
    let mut values: Vec<f64> =
        frames.iter().filter_map(|frame| frame.values.get("speed")).map(|value| value.components()[0]).collect();
    values.dedup();
    assert_eq!(values, [0.0, 32.0, 64.0, 127.0].map(|n| short(4.0 * n / 127.0)));
}

#[test]
fn gamepad_moves_uniforms_and_is_recorded() {
    let text = format!("#iChannel0 \"gamepad\"\n{TEXT}");
    let Some(mut room) = Fixture::with(&text) else { return };
    let happens = |room: &Fixture, event: PadEvent| room.pads.happens(event);
    let moved = |part: PadPart, value: f32| PadEvent::Moved { pad: 0, part, value };
    let (stick, south) = (PadPart::Axis(0), PadPart::Button(0));
    happens(&room, PadEvent::Connected { pad: 0, name: "Pad".into() });
    (0..5).for_each(|_| room.tick());
    assert_eq!(room.session.open.playback.gamepads, eddy_media::Gamepads::default(), "they are off");
    room.session.apply(ControlCommand::SetGamepads(true));
    room.until("a pad", |session| session.notices().iter().any(|n| n.text == "gamepad 1 connected: Pad"));
    let speed = ControlTarget::whole("speed");
    room.session.apply(ControlCommand::LearnControl(Some(speed.clone())));
    happens(&room, moved(stick, 0.1));
    happens(&room, moved(PadPart::Axis(1), 1.0));
    room.until("a control", |session| session.control_of(&speed).is_some());
    assert_eq!(room.bound(&speed).as_deref(), Some("pad 1 left-y"), "a stick at rest is not touched");
    room.until("the value", |session| session.project().custom_uniform_values.contains_key("speed"));
    assert_eq!(room.value("speed"), [4.0]);

    // A button draws a frame while time is paused, and is pressed in that frame only.
    room.session.apply(TransportCommand::Record);
    let frames = |session: &Session| session.open.playback.recorder.as_ref().unwrap().recording.frames.len();
    room.until("a frame", |session| frames(session) == 1);
    happens(&room, moved(south, 1.0));
    room.until("a frame", |session| frames(session) == 2);
    happens(&room, moved(south, 0.0));
    room.until("a frame", |session| frames(session) == 3);
    let recorded = &room.session.open.playback.recorder.as_ref().unwrap().recording.frames;
    let texels = |frame: usize| {
        let texels = recorded[frame].inputs.gamepads.texels();
        [texels[0], texels[1], texels[16], texels[17], texels[34]]
    };
    let rest = [0.1, 1.0, 1.0, 0.0, 0.0];
    assert_eq!([0, 1, 2].map(texels), [rest, [0.1, 1.0, 1.0, 1.0, 1.0], rest]);
    room.session.apply(ControlCommand::SetGamepads(false));
    assert_eq!(room.session.open.playback.gamepads, eddy_media::Gamepads::default());
}
