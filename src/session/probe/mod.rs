//! A value of the code that is drawn instead of the picture: the requested expression, the resulting value, and its
//! numbers.
//!
//! Owns the place in the text, which follows edits, and the rate at which numbers are read back from the device.
//! Drawing is the engine's, and the mapping of values to colours is [`eddy_engine::ValueLook`]'s.

mod statistics;

pub use statistics::{BINS, Statistics};

use crate::{
    drawing::{Finished, RenderTask, Renderer, Tasks, Ticket},
    read_back::{Moment, ReadBack},
};
use eddy_diag::follow;
use eddy_engine::{BuildOptions, Paint, Pixels, Sources, ValueLook};
use eddy_glsl::{Probe, ProbedExpression};
use eddy_project::{PassName, Project, Tab};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

/// The minimum interval of read-backs while time runs: each one waits for the device.
const EVERY: Duration = Duration::from_millis(100);
/// Read-backs take at most one part in this many of the time.
const SHARE: u32 = 20;

/// The requested expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProbePlace {
    pub tab: Tab,
    /// A byte offset in its text.
    pub at: usize,
    /// The number of earlier evaluations to skip: shows the value of the next one.
    pub visit: u32,
}

/// The display of the values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ProbeLook {
    /// `None`: from the minimum to the maximum.
    pub range: Option<(f32, f32)>,
    pub paint: Paint,
    pub channel: Option<u8>,
}

/// The probed expression in the running program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProbedValue {
    /// The pass in which it is evaluated.
    pub pass: PassName,
    pub text: String,
    pub type_text: String,
    pub components: u8,
    /// Its numbers are ints, uints or bools.
    pub is_whole: bool,
    /// The line, counted from 1.
    pub line: usize,
}

/// The state of a probe as a front end shows it.
#[derive(Clone, Copy, Debug)]
pub struct ProbeView<'s> {
    pub place: &'s ProbePlace,
    /// The value that is drawn, or why the picture is drawn instead; `None` before the first compile.
    pub value: Option<Result<&'s ProbedValue, &'s str>>,
    pub look: ProbeLook,
    pub numbers: Option<&'s ProbeNumbers>,
}

/// The numbers of a frame.
#[derive(Clone, Debug)]
pub struct ProbeNumbers {
    pub pixels: Pixels,
    pub statistics: Statistics,
}

/// The current probe, if there is one.
#[derive(Default)]
pub(super) struct ProbeState {
    wanted: Option<ProbeRequest>,
    /// The value in the running program.
    built: Option<Result<ProbedValue, String>>,
    look: ProbeLook,
    numbers: Option<Arc<ProbeNumbers>>,
    /// The drawn frame is newer than the numbers.
    is_due: bool,
    /// The time at which the numbers arrived, and how long that took.
    taken: Option<(Instant, Duration)>,
    /// The display that the engine was set to.
    engine_look: Option<ValueLook>,
    ticket: Ticket<Option<ProbeNumbers>>,
    /// New numbers have arrived, on which the display may depend.
    has_news: bool,
}

struct ProbeRequest {
    place: ProbePlace,
    /// The text that the place is in.
    text: Arc<str>,
    /// Its expression was deleted since.
    is_gone: bool,
}

/// Reads the values of the probe, and computes their statistics.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ReadNumbers {
    components: u8,
    range: Option<(f32, f32)>,
}

impl RenderTask for ReadNumbers {
    /// `None` for a program without a probe.
    type Output = Option<ProbeNumbers>;

    fn run(self, renderer: &mut Renderer) -> Self::Output {
        let pixels = renderer.engine_mut().read(&BuildOptions::probed()).ok()?;
        let statistics = Statistics::new(&pixels, self.components, self.range, true);
        Some(ProbeNumbers { pixels, statistics })
    }
}

impl ProbeState {
    /// Sets the probed expression, or none. Returns whether the program must be rebuilt.
    pub(crate) fn want(&mut self, place: Option<ProbePlace>, project: &Project) -> bool {
        let is_new = place.as_ref() != self.wanted.as_ref().map(|wanted| &wanted.place);
        let is_other = place.as_ref().map(|p| (&p.tab, p.at))
            != self.wanted.as_ref().map(|wanted| (&wanted.place.tab, wanted.place.at));
        if is_other {
            // A typed range is only for the previous numbers.
            self.look = ProbeLook { paint: self.look.paint, ..ProbeLook::default() };
        }
        self.wanted = place.and_then(|place| {
            let text = project.source(&place.tab)?.text.clone();
            Some(ProbeRequest { place, text, is_gone: false })
        });
        if self.wanted.is_none() {
            self.built = None;
            self.numbers = None;
        }
        is_new
    }

    /// Moves the place along with edits of the text.
    pub(crate) fn follow(&mut self, project: &Project) {
        let Some(wanted) = &mut self.wanted else { return };
        let Some(source) = project.source(&wanted.place.tab) else { return };
        if Arc::ptr_eq(&wanted.text, &source.text) {
            return;
        }
        // A deleted expression may return, such as by undo: the search starts from its last place.
        let found = follow(&wanted.text, &source.text, wanted.place.at);
        wanted.is_gone = found.is_none();
        if let Some(at) = found {
            wanted.place.at = at;
            wanted.text = source.text.clone();
        }
    }

    /// Returns the place to build for, and whether its expression was deleted.
    pub(crate) fn order(&self) -> Option<(ProbePlace, bool)> {
        self.wanted.as_ref().map(|wanted| (wanted.place.clone(), wanted.is_gone))
    }

    /// Sets the probe that the new program was built with.
    pub(crate) fn built(&mut self, built: Option<Result<ProbedValue, String>>) {
        self.built = built.filter(|_| self.wanted.is_some());
        self.is_due = true;
        if !self.is_drawn() {
            self.numbers = None;
        }
    }

    /// Returns whether the running program draws a value.
    pub(crate) fn is_drawn(&self) -> bool {
        matches!(self.built, Some(Ok(_)))
    }

    pub(crate) fn set_look(&mut self, look: ProbeLook) {
        self.look = look;
        self.is_due = true;
    }

    /// Returns the display for the engine if it has changed; always for a new program.
    pub(crate) fn take_look(&mut self, is_other_program: bool) -> Option<Option<ValueLook>> {
        let look = self.value_look();
        let is_new = std::mem::replace(&mut self.engine_look, look) != look;
        (is_new || is_other_program).then_some(look)
    }

    /// Returns whether numbers have arrived since the last call.
    pub(crate) fn take_news(&mut self) -> bool {
        std::mem::take(&mut self.has_news)
    }

    fn value_look(&self) -> Option<ValueLook> {
        let Some(Ok(value)) = &self.built else { return None };
        let ProbeLook { range, paint, channel } = self.look;
        let channel = channel.filter(|channel| *channel < value.components);
        let all = || self.numbers.as_ref().map_or((0.0, 1.0), |numbers| numbers.statistics.extent(channel));
        let (low, high) = range.unwrap_or_else(all);
        Some(ValueLook { low, high, paint, channel, components: value.components, has_gaps: true })
    }

    pub(crate) fn view(&self) -> Option<ProbeView<'_>> {
        let wanted = self.wanted.as_ref()?;
        let value = self.built.as_ref().map(|built| built.as_ref().map_err(String::as_str));
        Some(ProbeView { place: &wanted.place, value, look: self.look, numbers: self.numbers.as_deref() })
    }

    /// Returns what to read back now. While time runs, another frame follows anyway, so read-backs are rate-limited.
    fn due(&mut self, now: Instant, is_running: bool) -> Option<ReadNumbers> {
        let Some(Ok(value)) = &self.built else { return None };
        let is_early = |(at, took): (Instant, Duration)| now.saturating_duration_since(at) < EVERY.max(SHARE * took);
        if !self.is_due || (is_running && self.taken.is_some_and(is_early)) {
            return None;
        }
        self.is_due = false;
        self.taken = Some((now, self.taken.map_or(Duration::ZERO, |(_, took)| took)));
        Some(ReadNumbers { components: value.components, range: self.look.range })
    }
}

impl ReadBack for ProbeState {
    fn request(&mut self, at: &Moment, tasks: &mut Tasks) {
        if let Some(task) = self.due(at.now, at.is_playing) {
            self.ticket = tasks.add(task);
        }
    }

    fn receive(&mut self, has_frame: bool) -> bool {
        let Some(Finished { output: Some(numbers), took }) = self.ticket.take() else {
            self.is_due |= has_frame;
            return false;
        };
        if self.is_drawn() {
            self.taken = self.taken.map(|(at, _)| (at, took));
            self.numbers = Some(Arc::new(numbers));
        }
        self.has_news = true;
        true
    }
}

/// Returns the build options: the probe, and every buffer that Image may need, as a simulation continues even while it
/// is not shown.
pub(super) fn options(
    project: &Project,
    shown: &PassName,
    (place, is_gone): &(ProbePlace, bool),
) -> Result<(BuildOptions, ProbedValue), String> {
    let pass = match &place.tab {
        Tab::Pass(pass) if pass.is_sound() => return Err("a sound pass has no pixels to probe".into()),
        Tab::Pass(pass) => pass.clone(),
        Tab::Common => shown.clone(),
        Tab::Included(_) => {
            let users = project.tabs_that_include(&place.tab);
            let is_shown = |user: &&Tab| matches!(user, Tab::Common) || user.pass() == Some(shown);
            let user = users.iter().find(is_shown).or(users.iter().find(|user| matches!(user, Tab::Pass(_))));
            user.and_then(Tab::pass).unwrap_or(shown).clone()
        }
        Tab::Stage(..) => return Err("passes that draw meshes cannot be probed".into()),
    };
    let gone = || "No expression at the caret: showing the picture".to_owned();
    if *is_gone {
        return Err(gone());
    }
    let index = project.passes.iter().position(|p| p.id == pass).ok_or_else(gone)?;
    let source = match &place.tab {
        Tab::Pass(_) => Project::pass_id(index),
        tab => project.id_of(tab).ok_or_else(gone)?,
    };
    let probe = Probe { source, at: place.at as u32, visit: place.visit };
    let ProbedExpression { span, type_text, components, is_whole } =
        Sources::new(project).probed(index, &probe).ok_or_else(gone)?;
    let sources = project.sources();
    let at = sources.line_column(span).ok_or_else(gone)?;
    let text = sources.get(span.source).and_then(|source| source.text.get(span.range())).unwrap_or_default();
    let value = ProbedValue {
        pass: pass.clone(),
        text: text.split_whitespace().collect::<Vec<_>>().join(" "),
        type_text,
        components,
        is_whole,
        line: at.line,
    };
    let mut wanted = vec![BuildOptions::probed()];
    wanted.extend(needed(project, &pass));
    Ok((BuildOptions { requested: wanted, probe: Some((pass, probe)), ..BuildOptions::default() }, value))
}

/// Returns the buffers that Image and the probed pass read, and those that these read in turn.
fn needed(project: &Project, probed: &PassName) -> Vec<PassName> {
    let mut found = project.image_and(probed);
    let mut next = 0;
    while let Some(pass) = found.get(next).and_then(|id| project.pass(id)) {
        next += 1;
        for channel in pass.bindings.channels() {
            let read = channel.input.target().map(|(id, _)| id);
            if let Some(id) = read.filter(|id| project.pass(id).is_some() && !found.contains(id)) {
                found.push(id.clone());
            }
        }
    }
    found.split_off(1)
}
