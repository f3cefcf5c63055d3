//! Controls of OSC, MIDI and gamepads: which are enabled, which uniform a control moves, and what is being learned.
//!
//! Nothing is listened to before the user has enabled it. A uniform that a control moves is treated like one set by a
//! slider: recordings contain its values, and one movement is one undo step.

mod gamepads;

use super::{
    SessionOptions,
    command::ControlCommand,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_control::{
    ControlEvent, ControlQueue, Movement, OWN_UNITS, PickupSide, Takeover, Wake, direct,
    midi::{MidiChoice, MidiInputs, MidiState, host::MidiHost},
    moved,
    osc::{Listener, OscInput, OscState, dispatched, is_pattern},
    pads::{PadHost, PadInputs, PadState},
    place_of,
};
use eddy_project::{ControlAddress, ControlTarget, CustomUniform, CustomUniformType, CustomUniformValue, PadPart};
use std::{
    collections::{BTreeMap, BTreeSet, HashMap},
    net::SocketAddr,
    sync::Arc,
    time::{Duration, Instant},
};

/// The remaining messages of a control that sends several arrive within this time after the first, by which it was
/// learned.
const FINE_PART: Duration = Duration::from_millis(200);
/// The MIDI controllers that select a non-registered parameter and set its value.
const OF_PARAMETERS: [u8; 4] = [99, 98, 6, 38];
/// TouchOSC sends 1 to an address with this ending when a finger touches a control, and 0 when it leaves.
const TOUCH: &str = "/z";

/// The devices that are listened to, and what is being learned.
pub(super) struct Controls {
    host: Option<Arc<dyn MidiHost>>,
    on_thread: bool,
    wake: Wake,
    queue: ControlQueue,
    osc: Option<OscInput>,
    midi: Option<MidiInputs>,
    choice: MidiChoice,
    pad_host: Option<Arc<dyn PadHost>>,
    pads: Option<PadInputs>,
    /// The user was told that gamepads cannot be read.
    is_pad_told: bool,
    /// The target that the next control to move is bound to.
    learning: Option<ControlTarget>,
    /// Learned from a controller that may be a part of another control: the coarse part of a 14-bit one, or one that
    /// selects a parameter.
    part: Option<(ControlTarget, ControlAddress, Instant)>,
    /// The knobs that have moved since the project was opened, by their targets.
    takeovers: BTreeMap<ControlTarget, Takeover>,
    /// The user was told that OSC cannot be received.
    is_osc_told: bool,
    is_midi_told: bool,
    /// The devices that were announced to the user.
    announced: Vec<String>,
}

/// The state of all controls, for a front end.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlsView {
    /// `None` if OSC is off.
    pub osc: Option<OscState>,
    /// OSC is received on addresses other than the machine's own.
    pub is_osc_public: bool,
    pub has_midi: bool,
    pub choice: MidiChoice,
    pub midi: MidiState,
    pub has_gamepads: bool,
    /// `None` if gamepads are off.
    pub gamepads: Option<PadState>,
}

impl ControlsView {
    /// Returns whether any source of controls is enabled.
    pub fn is_on(&self) -> bool {
        self.osc.is_some() || self.choice != MidiChoice::Off || self.gamepads.is_some()
    }
}

impl Controls {
    pub(crate) fn apply(&mut self, open: &mut OpenProject, command: ControlCommand) {
        match command {
            ControlCommand::SetOsc(address) => self.set_osc(open, address),
            ControlCommand::SetMidi(choice) => self.set_midi(open, choice),
            ControlCommand::SetGamepads(on) => self.set_gamepads(open, on),
            ControlCommand::ListMidiDevices => self.list_midi_devices(),
            ControlCommand::LearnControl(target) => self.learn_control(open, target),
            ControlCommand::ForgetControl(target) => self.forget_control(open, &target),
        }
    }

    pub(crate) fn new(options: &SessionOptions, wake: Wake) -> Self {
        Self {
            host: options.midi.clone(),
            on_thread: options.audio_on_thread,
            queue: ControlQueue::new(wake.clone()),
            wake,
            osc: None,
            midi: None,
            choice: MidiChoice::Off,
            pad_host: options.gamepads.clone(),
            pads: None,
            is_pad_told: false,
            learning: None,
            part: None,
            takeovers: BTreeMap::new(),
            is_osc_told: false,
            is_midi_told: false,
            announced: Vec::new(),
        }
    }

    /// Cancels learning, which was for the previous project.
    pub(crate) fn close_project(&mut self) {
        (self.learning, self.part) = (None, None);
        self.takeovers.clear();
    }

    /// Returns the MIDI inputs, creating them if necessary and if the machine has MIDI. This does not open a device.
    fn midi(&mut self) -> Option<&mut MidiInputs> {
        if self.midi.is_none() {
            let host = self.host.as_deref()?;
            let made = match self.on_thread {
                true => MidiInputs::on_thread(host, self.queue.clone(), self.wake.clone()),
                false => Ok(MidiInputs::here(host, self.queue.clone())),
            };
            self.midi = Some(made.inspect_err(|e| log::warn!("no thread for MIDI: {e}")).ok()?);
        }
        self.midi.as_mut()
    }
}

impl Controls {
    /// Returns the state of all controls.
    pub(crate) fn controls_view(&self) -> ControlsView {
        let controls = &self;
        ControlsView {
            osc: controls.osc.as_ref().map(OscInput::state),
            is_osc_public: controls.osc.as_ref().is_some_and(|osc| !osc.asked().ip().is_loopback()),
            has_midi: controls.host.is_some(),
            choice: controls.choice.clone(),
            midi: controls.midi.as_ref().map(MidiInputs::state).unwrap_or_default(),
            has_gamepads: controls.pad_host.is_some(),
            gamepads: controls.pads.as_ref().map(PadInputs::state),
        }
    }

    /// Returns whether a target's control is being learned.
    pub(crate) fn is_learning(&self, open: &OpenProject, target: &ControlTarget) -> bool {
        self.learning.as_ref() == Some(&open.as_in_texts(target))
    }

    /// Returns the side of the value on which the target's knob waits for pickup; `None` if it does not wait.
    pub(crate) fn control_waits(&self, open: &OpenProject, target: &ControlTarget) -> Option<PickupSide> {
        let target = open.as_in_texts(target);
        open.project().controls.get(&target).and_then(|_| self.takeovers.get(&target)?.waits())
    }

    /// Listens to OSC at an address; `None` stops it.
    pub(super) fn set_osc(&mut self, open: &mut OpenProject, address: Option<SocketAddr>) {
        if self.osc.as_ref().map(OscInput::asked) == address {
            return;
        }
        open.dismiss_notices(About::Osc);
        self.is_osc_told = false;
        // Close the old socket first: the new one may have the same address.
        self.osc = None;
        let Some(address) = address else { return };
        match OscInput::listen(address, self.queue.clone(), open.host.wake.clone()) {
            Ok(osc) => self.osc = Some(osc),
            Err(error) => open.notice_about(About::Osc, Level::Warning, format!("no thread for OSC: {error}")),
        }
    }

    pub(super) fn set_midi(&mut self, open: &mut OpenProject, choice: MidiChoice) {
        if self.choice == choice {
            return;
        }
        open.dismiss_notices(About::Midi);
        (self.is_midi_told, self.announced) = (false, Vec::new());
        self.choice = choice.clone();
        if let Some(midi) = self.midi() {
            midi.choose(choice);
        }
    }

    pub(super) fn list_midi_devices(&mut self) {
        if let Some(midi) = self.midi() {
            midi.ask_names();
        }
    }

    /// Binds the next control that moves; `None` cancels it.
    pub(super) fn learn_control(&mut self, open: &mut OpenProject, target: Option<ControlTarget>) {
        self.part = None;
        self.learning = target.map(|target| open.as_in_texts(&target));
    }

    pub(super) fn forget_control(&mut self, open: &mut OpenProject, target: &ControlTarget) {
        let target = open.as_in_texts(target);
        if open.project().controls.contains_key(&target) {
            open.documents.current_mut().controls.remove(&target);
        }
        self.takeovers.remove(&target);
        if self.learning.as_ref() == Some(&target) {
            self.learning = None;
        }
    }

    /// Applies what controls have sent, before frames are drawn.
    pub(super) fn follow_controls(&mut self, open: &mut OpenProject) {
        if let Some(midi) = &mut self.midi {
            midi.step(open.host.now);
        }
        self.report_osc_state(open);
        self.report_midi_state(open);
        self.follow_gamepads(open);
        let events = self.queue.take();
        if events.is_empty() {
            return;
        }
        let events = dispatched(events, || open.osc_listeners());
        self.learn(open, &events);
        self.apply_controls(open, &events);
    }

    fn report_osc_state(&mut self, open: &mut OpenProject) {
        let Some(osc) = &self.osc else { return };
        match osc.state() {
            OscState::Missing(why) if !std::mem::replace(&mut self.is_osc_told, true) => {
                let at = osc.asked();
                let text = format!("OSC cannot listen at {at}: {why}. Eddy tries again every 3 seconds");
                open.notice_about(About::Osc, Level::Warning, text);
            }
            OscState::Listening(at) if std::mem::take(&mut self.is_osc_told) => {
                open.dismiss_notices(About::Osc);
                open.notice_about(About::Osc, Level::Info, format!("OSC listens at {at}"));
            }
            OscState::Starting | OscState::Missing(_) | OscState::Listening(_) => {}
        }
    }

    fn report_midi_state(&mut self, open: &mut OpenProject) {
        let state = match &self.midi {
            Some(midi) if self.choice != MidiChoice::Off => midi.state(),
            _ => return,
        };
        let announced = std::mem::replace(&mut self.announced, state.open.clone());
        for name in state.open.iter().filter(|name| !announced.contains(name)) {
            open.notice_about(About::Midi, Level::Info, format!("MIDI device connected: {name}"));
        }
        for name in announced.iter().filter(|name| !state.open.contains(name)) {
            open.notice_about(About::Midi, Level::Info, format!("MIDI device disconnected: {name}"));
        }
        match state.missing {
            Some(why) if !std::mem::replace(&mut self.is_midi_told, true) => {
                let text = format!("MIDI: {why}. Eddy looks for devices every 2 seconds");
                open.notice_about(About::Midi, Level::Warning, text);
            }
            None if std::mem::take(&mut self.is_midi_told) => open.dismiss_notices(About::Midi),
            _ => {}
        }
    }

    /// Binds the touched control to the target that is being learned.
    fn learn(&mut self, open: &mut OpenProject, events: &[ControlEvent]) {
        if let Some((target, part, since)) = self.part.clone() {
            if open.host.now.saturating_duration_since(since) > FINE_PART {
                self.part = None;
            } else if let Some(whole) = whole_of(&part, events) {
                self.part = None;
                self.bind(open, target, whole);
            }
        }
        let Some(target) = &self.learning else { return };
        let Some(address) = touched(events, target.index()) else { return };
        let target = target.clone();
        self.learning = None;
        let whole = whole_of(&address, events);
        if whole.is_none() {
            self.part = Some((target.clone(), address.clone(), open.host.now));
        }
        let address = whole.unwrap_or(address);
        open.notice_about(About::Controls, Level::Info, format!("{target} is mapped to {}", address.label()));
        self.bind(open, target, address);
    }

    /// Binds a control to a target and applies its value at once.
    fn bind(&mut self, open: &mut OpenProject, target: ControlTarget, address: ControlAddress) {
        self.takeovers.insert(target.clone(), Takeover::learned());
        open.documents.current_mut().controls.insert(target, address);
        open.host.changed = true;
    }

    /// Sets the uniforms of the controls that have moved.
    fn apply_controls(&mut self, open: &mut OpenProject, events: &[ControlEvent]) {
        let before = open.project().custom_uniform_values.clone();
        let bindings = open.project().controls.clone();
        let uniforms: Vec<CustomUniform> = open
            .custom_uniforms()
            .iter()
            .map(|uniform| CustomUniform { name: open.newest_name(&uniform.name), ..uniform.clone() })
            .collect();
        // Many events arrive at once if a pattern matches many addresses.
        let by_name: HashMap<&str, &CustomUniform> = uniforms.iter().rev().map(|it| (it.name.as_str(), it)).collect();
        let mut by_address: BTreeMap<&ControlAddress, Vec<&ControlTarget>> = BTreeMap::new();
        bindings.iter().for_each(|(target, address)| by_address.entry(address).or_default().push(target));
        let mut turned = BTreeSet::new();
        for event in newest(events) {
            let bound = by_address.get(&event.source).into_iter().flatten().copied();
            let bound = bound.map(|target| (target.uniform.as_str(), target.index(), Some(target)));
            let named = direct(&event.source).map(|moved| (moved.uniform, moved.index, None));
            for (name, index, target) in bound.chain(named) {
                let Some(uniform) = by_name.get(name).copied() else { continue };
                let now = uniform.value(&open.project().custom_uniform_values);
                let value = moved(uniform, &now, index, event, target.is_none()).map(CustomUniformValue::shortest);
                if target.is_some_and(|target| !self.takes_over(target, uniform, &now, value.as_ref(), event)) {
                    continue;
                }
                if let Some(value) = value {
                    open.documents.current_mut().turn_custom_uniform(uniform, value);
                    turned.insert(uniform.name.clone());
                }
            }
        }
        // Redraw to show a knob that waits.
        open.host.changed |= !events.is_empty();
        if open.project().custom_uniform_values != before {
            open.pass_history.push_controls(before, turned, open.host.now);
            open.custom_uniforms_changed();
            open.host.changed = true;
        }
    }
}

impl OpenProject {
    /// Returns a target with its uniform's name in the texts, which the program that draws may not know yet.
    pub(crate) fn as_in_texts(&self, target: &ControlTarget) -> ControlTarget {
        ControlTarget { uniform: self.newest_name(&target.uniform), ..target.clone() }
    }

    /// Returns the OSC addresses that are bound, to match patterns against.
    fn osc_listeners(&self) -> Vec<Listener> {
        let bound = self.project().controls.values().filter_map(|address| match address {
            ControlAddress::Osc { path, argument } => Some((path.clone(), argument + 1)),
            _ => None,
        });
        let named = self.custom_uniforms().iter().flat_map(|uniform| {
            let path = format!("{OWN_UNITS}{}", self.newest_name(&uniform.name));
            let count = uniform.ty.components();
            let letters = if uniform.ty == CustomUniformType::Color3 { "rgba" } else { "xyzw" };
            let letters = letters.chars().take(if count > 1 { count } else { 0 });
            let parts: Vec<_> = letters.map(|letter| (format!("{path}/{letter}"), 1)).collect();
            std::iter::once((path, count)).chain(parts)
        });
        let mut all: BTreeMap<String, usize> = BTreeMap::new();
        for (path, arguments) in bound.chain(named) {
            let most = all.entry(path).or_default();
            *most = arguments.max(*most);
        }
        all.into_iter().map(|(path, arguments)| Listener { path, arguments }).collect()
    }
}

impl Controls {
    /// Returns whether a control moves its target now, or still waits until it reaches the target's value.
    fn takes_over(
        &mut self,
        target: &ControlTarget,
        uniform: &CustomUniform,
        now: &CustomUniformValue,
        moved: Option<&CustomUniformValue>,
        event: &ControlEvent,
    ) -> bool {
        let index = target.index();
        let number = |value: &CustomUniformValue| value.components().get(index).copied();
        let Some(value) = number(now) else { return false };
        let Some(slider) = place_of(uniform, index, value).filter(|_| event.source.stays_in_place()) else {
            return true;
        };
        let target_value = moved.map_or(Some(value), number).unwrap_or(value);
        let movement = Movement { knob: event.value, slider, value, target: target_value };
        self.takeovers.entry(target.clone()).or_default().moves(movement)
    }
}

/// Returns the control that a controller is a part of, if it has moved: a 14-bit control for its coarse part, or a
/// parameter for a controller that selects or sets it.
fn whole_of(part: &ControlAddress, events: &[ControlEvent]) -> Option<ControlAddress> {
    let ControlAddress::ControlChange { channel, number } = part else { return None };
    let is_whole = |address: &ControlAddress| match address {
        ControlAddress::ControlChange14 { channel: of, number: coarse } => of == channel && coarse == number,
        ControlAddress::Nrpn { channel: of, .. } => of == channel && OF_PARAMETERS.contains(number),
        _ => false,
    };
    events.iter().map(|event| &event.source).find(|address| is_whole(address)).cloned()
}

/// Returns the control that was touched. `index` is the target's component of a vector: if an OSC message has an
/// argument for each component, the one at `index` is bound.
fn touched(events: &[ControlEvent], index: usize) -> Option<ControlAddress> {
    let is_touched = |event: &&ControlEvent| match &event.source {
        // Ignores the release of a key.
        ControlAddress::Note { .. } => event.value > 0.0,
        // Ignores a stick that is not quite at rest, and a trigger that is brushed.
        ControlAddress::Pad { part: PadPart::Axis(_), .. } => (event.value - 0.5).abs() > 0.25,
        ControlAddress::Pad { part: PadPart::Button(_), .. } => event.value > 0.5,
        ControlAddress::Osc { path, .. } => {
            let is_finger = path.ends_with(TOUCH) && (event.value == 0.0 || event.value == 1.0);
            direct(&event.source).is_none() && !is_finger && !is_pattern(path)
        }
        _ => true,
    };
    let first = events.iter().find(is_touched)?;
    let ControlAddress::Osc { path, .. } = &first.source else { return Some(first.source.clone()) };
    let own = ControlAddress::Osc { path: path.clone(), argument: index };
    let has_own = events.iter().any(|event| event.source == own);
    Some(if has_own { own } else { first.source.clone() })
}

/// Returns the events in their order: the last one of each control, but all of keys, as each press toggles something.
fn newest(events: &[ControlEvent]) -> Vec<&ControlEvent> {
    let mut seen = BTreeSet::new();
    let mut kept = Vec::new();
    for event in events.iter().rev() {
        if matches!(event.source, ControlAddress::Note { .. }) || seen.insert(&event.source) {
            kept.push(event);
        }
    }
    kept.reverse();
    kept
}

#[cfg(test)]
mod tests;
