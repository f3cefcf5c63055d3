//! Interactive examination of a traced pixel: watches, breakpoints with conditions, `//@print` comments.

use super::{
    Extent, Trace, TraceError,
    history::{History, HistoryRecorder},
    travel::{self, Direction},
    ulps,
    watch_expression::{Watched, Watches},
};
use crate::fragment::{Fragment, MeshFragment, Origin, PassFragments, PixelContent};
use eddy_diag::{SourceId, Span};
use eddy_engine::{PassInputs, Pixels, Sources};
use eddy_glsl::{
    walk::{EntryInputs, Shadowed, Stop},
    walkable::Detail,
};
use eddy_project::{FillKind, PassName, Project, Stage, Tab, TexelFormat, inspect_comments};
use std::sync::Arc;

/// The number of statements after which a walk is stopped: a few seconds.
const MAX_STATEMENTS: u64 = 20_000_000;
/// The limit of values that a comment prints.
const MAX_PRINTED: usize = 1000;

/// A pixel of a pass at a frame, with the execution that leads to its value.
#[derive(Debug)]
pub struct Traced {
    /// The texts that were walked.
    pub project: Project,
    pub pass: PassName,
    /// The text with the pass's entry point; for a pass that draws meshes the fragment stage of a draw.
    pub tab: Tab,
    text_id: SourceId,
    index: usize,
    /// The origin of the value: a program of the pass.
    pub origin: Origin,
    pub pixel: (u32, u32),
    pub size: (u32, u32),
    pub frame: i32,
    pub history: History,
    /// The walker's value; `None` if the pass draws nothing there.
    pub value: Option<[f32; 4]>,
    /// The same path in double precision.
    pub double: Option<[f64; 4]>,
    /// The texel that the device drew, as stored.
    pub device: [f32; 4],
    pub format: TexelFormat,
    /// The walk was stopped at its limit: the history is incomplete.
    pub is_endless: bool,
    inputs: PassInputs,
    entry: EntryInputs,
}

/// A line at which execution stops if a condition is true.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Breakpoint {
    pub tab: Tab,
    /// From 0.
    pub line: usize,
    /// Empty for none.
    pub condition: String,
    pub is_on: bool,
}

/// The values that a comment printed, one for each time that it was reached.
#[derive(Clone, Debug)]
pub struct Printed {
    pub tab: Tab,
    /// From 0.
    pub line: usize,
    pub expression: String,
    /// The moments, and the value at each.
    pub values: Vec<(usize, Watched)>,
    /// It was reached more often than that.
    pub is_cut: bool,
}

impl Traced {
    /// Walks a pass for the pixel at a position of its picture, from 0 to 1 across and up. Fails if the pass draws
    /// meshes and none of them is drawn at the pixel, and if its boundary or nothing is drawn there.
    pub fn new(
        project: Project,
        pass: &PassName,
        frame: i32,
        (inputs, drawn): (PassInputs, &Pixels),
        place: [f32; 2],
    ) -> Result<Self, TraceError> {
        let index = project.passes.iter().position(|p| p.id == *pass).ok_or(TraceError::Gone)?;
        let texel = |part: f32, count: u32| ((part * count as f32) as u32).min(count.saturating_sub(1));
        let pixel = (texel(place[0], inputs.size.0), texel(place[1], inputs.size.1));
        let sources = Sources::new(&project);
        let walked = PassFragments::new(&sources, index, &inputs, Detail::Statements, MAX_STATEMENTS)?;
        drop(sources);
        let at = match walked.at(pixel)? {
            PixelContent::Undrawn(Origin::Clear) => return Err(TraceError::Clear(pixel)),
            PixelContent::Undrawn(Origin::Outside(region)) => return Err(TraceError::Kept { pixel, region }),
            PixelContent::Undrawn(_) | PixelContent::Fragment(Fragment { origin: Origin::Boundary, .. }) => {
                return Err(TraceError::Boundary { pixel, written: boundary(&project, index) });
            }
            PixelContent::Fragment(at) => at,
        };
        let mut recorder = HistoryRecorder::new(at.walkable);
        // One walk computes both: single precision does not depend on the double-precision shadows.
        let run = at.machine::<Shadowed>().run(at.lane, &mut recorder);
        let recorded = recorder.end();
        let is_endless = matches!(run, Err(Stop::Steps(_)));
        let numbers = run.ok().and_then(|drawn| at.value(&drawn));
        let value = numbers.map(|numbers| numbers.map(|number| number.single));
        let double = numbers.map(|numbers| numbers.map(|number| number.double));
        let (origin, entry) = (at.origin, at.inputs);
        let history = recorded.of(walked.into_walkable(origin));
        let device = drawn.texels.get((pixel.1 * drawn.width + pixel.0) as usize).copied().unwrap_or_default();
        let body = &project.passes[index].body;
        let draw = origin.draw().and_then(|draw| body.draws().get(draw));
        let text_id = project.stage_id(index, draw.map_or(Stage::Own, |draw| draw.fragment));
        Ok(Self {
            index,
            pass: pass.clone(),
            tab: project.tab_of(text_id).unwrap_or_else(|| Tab::Pass(pass.clone())),
            text_id,
            origin,
            pixel,
            size: inputs.size,
            frame,
            history,
            value,
            double,
            device,
            format: project.passes[index].formats().first().copied().unwrap_or_default(),
            is_endless,
            inputs,
            entry,
            project,
        })
    }

    /// Returns the number of single-precision numbers between the walker's value and the device's, for each stored
    /// component; `None` if the format has fewer bits.
    pub fn ulps(&self) -> Option<Vec<u32>> {
        let value = self.value.filter(|_| self.format.is_32_bit())?;
        Some((0..self.format.components()).map(|i| ulps(value[i], self.device[i])).collect())
    }

    /// Returns the index of the pass in the project.
    pub fn index(&self) -> usize {
        self.index
    }

    /// Repeats the walk and returns its steps.
    pub fn trace(&self, extent: Extent) -> Result<Trace, TraceError> {
        super::trace(&Sources::new(&self.project), self.index, &self.inputs, self.pixel, extent)
    }

    /// Returns the mesh fragment that the value comes from, and the name of its mesh; `None` if the pass draws no
    /// meshes.
    pub fn mesh(&self) -> Option<(MeshFragment, String)> {
        let Origin::Mesh(fragment) = self.origin else { return None };
        let draw = self.project.passes[self.index].body.draws().get(fragment.draw)?;
        Some((fragment, draw.mesh.name()))
    }

    /// Returns the tab of a place of the texts, its line from 0, and its bytes. `None` for a text that is not a tab.
    pub fn place(&self, span: Span) -> Option<(Tab, usize, std::ops::Range<usize>)> {
        let tab = self.project.tab_of(span.source)?;
        let text = &self.project.source(&tab)?.text;
        let line = text.get(..span.start as usize)?.matches('\n').count();
        Some((tab, line, span.range()))
    }

    /// Returns the text of a tab, as it was walked.
    pub fn text(&self, tab: &Tab) -> &str {
        self.project.source(tab).map_or("", |source| &source.text)
    }

    fn source(&self, tab: &Tab) -> Option<SourceId> {
        match tab {
            Tab::Common => Some(Project::COMMON_ID),
            tab if *tab == self.tab => Some(self.text_id),
            Tab::Included(_) => self.project.id_of(tab),
            _ => None,
        }
    }

    /// Returns the statement for a line: its own or the next one.
    pub fn statement_at(&self, tab: &Tab, line: usize) -> Option<u32> {
        let text = self.text(tab);
        let start = text.split_inclusive('\n').take(line).map(str::len).sum::<usize>();
        self.history.statement_from(self.source(tab)?, start as u32)
    }

    /// Returns the line, from 0, at which a breakpoint of a line actually stops.
    pub fn line_of(&self, statement: u32) -> Option<usize> {
        Some(self.place(self.history.statement_head(statement)?)?.1)
    }
}

/// Returns the location of a pass's boundary in its manifest, and its value there.
fn boundary(project: &Project, index: usize) -> String {
    let (sources, span) = (project.sources(), project.fill_span(index, FillKind::Boundary));
    let source = span.and_then(|span| Some((sources.get(span.source)?, sources.line_column(span)?.line, span)));
    source.map_or_else(String::new, |(source, line, span)| {
        let text = source.text.get(span.range()).unwrap_or_default();
        format!("{}:{line}, {},", source.name, text.split_whitespace().collect::<Vec<_>>().join(" "))
    })
}

/// A traced pixel with its watches.
pub struct Examiner {
    pub traced: Arc<Traced>,
    watches: Watches,
}

impl Examiner {
    pub fn new(traced: Arc<Traced>) -> Self {
        Self { traced, watches: Watches::default() }
    }

    /// Evaluates an expression at a moment.
    pub fn watch(&mut self, at: usize, expression: &str) -> Watched {
        let traced = &*self.traced;
        let draw = traced.origin.draw();
        let place = (&traced.project, traced.index, draw);
        let read = (&traced.inputs.of_draw(draw), &traced.entry, traced.pixel);
        self.watches.value((&traced.history, at), place, read, expression)
    }

    /// Returns the nearest moment in a direction at which a breakpoint stops. A condition that is not a truth value or
    /// number, or does not compile, also stops; its error is shown at the breakpoint.
    pub fn continue_to_breakpoint(
        &mut self,
        at: usize,
        breakpoints: &[Breakpoint],
        direction: Direction,
    ) -> Option<usize> {
        let traced = self.traced.clone();
        let on = breakpoints.iter().filter(|breakpoint| breakpoint.is_on);
        let stops: Vec<(u32, &str)> =
            on.filter_map(|b| Some((traced.statement_at(&b.tab, b.line)?, b.condition.trim()))).collect();
        let is_there = |statement: u32| stops.iter().any(|(at, _)| *at == statement);
        let accepts = |other: usize| {
            let statement = traced.history.statement_of(other);
            let mut here = stops.iter().filter(|(at, _)| Some(*at) == statement);
            here.any(|(_, condition)| condition.is_empty() || self.is_true_at(other, condition).unwrap_or(true))
        };
        travel::run(&traced.history, at, is_there, accepts, direction)
    }

    /// Returns whether a condition is true at a moment.
    pub fn is_true_at(&mut self, at: usize, condition: &str) -> Result<bool, String> {
        match &self.watch(at, condition)?.numbers[..] {
            [number] => Ok(number.as_f64() != 0.0),
            _ => Err("a condition is a bool or a number".into()),
        }
    }

    /// Returns the nearest moment in a direction at which a line runs.
    pub fn run_to(&self, at: usize, (tab, line): (&Tab, usize), direction: Direction) -> Option<usize> {
        let statement = self.traced.statement_at(tab, line)?;
        travel::run(&self.traced.history, at, |other| other == statement, |_| true, direction)
    }

    /// Returns the values that the comments of the texts print.
    pub fn printed(&mut self) -> Vec<Printed> {
        let traced = self.traced.clone();
        let tabs = [Tab::Common, traced.tab.clone()];
        let mut found = Vec::new();
        for tab in tabs {
            let Some(source) = traced.source(&tab) else { continue };
            for comment in inspect_comments(traced.text(&tab)).iter().filter(|comment| comment.kind == "print") {
                let mut values = Vec::new();
                let mut is_cut = false;
                for at in traced.history.moments_of_comment(source, traced.text(&tab), comment.at as u32) {
                    is_cut = values.len() == MAX_PRINTED;
                    if is_cut {
                        break;
                    }
                    values.push((at, self.watch(at, comment.argument)));
                }
                let (line, expression) = (comment.line, comment.argument.to_owned());
                found.push(Printed { tab: tab.clone(), line, expression, values, is_cut });
            }
        }
        found
    }
}
