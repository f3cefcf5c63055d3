//! The state of the debugger, and its actions.

use super::moment::{MomentState, Rows};
use crate::{
    debugger::trace::{
        Breakpoint, Examiner, Printed, Traced,
        travel::{self, Direction},
    },
    diag::follow_line,
    gui::{actions::TraceAction, editor::Debug},
    project::Tab,
    session::{KeptBreakpoint, Session},
};
use std::{collections::HashMap, sync::Arc};

/// The state of the debugger.
#[derive(Default)]
pub(crate) struct Debugger {
    pub(super) examiner: Option<Examiner>,
    /// The current moment, and the one that was shown before.
    pub(super) at: usize,
    before: Option<usize>,
    pub(super) breakpoints: Vec<Breakpoint>,
    /// The breakpoints as the session keeps them; `None` until they are taken over from it.
    kept: Option<Vec<KeptBreakpoint>>,
    /// The texts to which the breakpoints' lines refer.
    texts: HashMap<Tab, String>,
    pub(super) watches: Vec<String>,
    pub(super) new_watch: String,
    /// The variable that is plotted; `None`: the first that changes.
    pub(super) plotted: Option<String>,
    /// The contents of the current moment.
    pub(super) seen: Option<MomentState>,
    /// The rows of the previous moment: most moments are in the same loop.
    rows: Option<Rows>,
    pub(super) printed: Option<Vec<Printed>>,
    /// The message about the newest step.
    pub(super) message: Option<&'static str>,
    /// The editor is to show the line.
    reveals: bool,
}

impl Debugger {
    /// Takes over the session's newest trace.
    pub(crate) fn prepare(&mut self, session: &Session) {
        if self.kept.is_none() {
            self.restore(session);
        }
        self.follow_texts(session);
        let traced = session.trace().traced;
        let known = self.examiner.as_ref().map(|examiner| &examiner.traced);
        let is_same = match (traced, known) {
            (Some(new), Some(known)) => Arc::ptr_eq(new, known),
            (None, None) => true,
            _ => false,
        };
        if is_same {
            return;
        }
        // Another frame, or the same code: the position is kept.
        let stays = traced.zip(known).is_some_and(|(new, known)| is_like(new, known));
        // Editing while a pixel is traced must not scroll away from the caret.
        self.reveals = traced.zip(known).is_none_or(|(new, known)| !is_of_pixel(new, known));
        self.examiner = traced.map(|traced| Examiner::new(traced.clone()));
        (self.seen, self.rows, self.printed, self.message) = (None, None, None, None);
        let Some(traced) = traced else { return };
        let first = travel::end(&traced.history, Direction::Back).unwrap_or(0);
        if !stays || self.at >= traced.history.moments.len() {
            (self.at, self.before) = (first, None);
        }
    }

    /// Takes over the breakpoints with which the project was closed.
    fn restore(&mut self, session: &Session) {
        let kept = session.kept_breakpoints().to_vec();
        for KeptBreakpoint { tab, line, condition, disabled } in &kept {
            let Some(tab) = session.tabs().into_iter().find(|known| known.title() == *tab) else { continue };
            let Some(line) = line.checked_sub(1).filter(|line| *line < session.text(&tab).lines().count()) else {
                continue;
            };
            self.texts.entry(tab.clone()).or_insert_with(|| session.text(&tab).to_owned());
            self.breakpoints.push(Breakpoint { tab, line, condition: condition.clone(), is_on: !disabled });
        }
        self.kept = Some(kept);
    }

    /// Returns the breakpoints if they have changed since the last call.
    pub(crate) fn take_changed(&mut self) -> Option<Vec<KeptBreakpoint>> {
        let keep = |b: &Breakpoint| KeptBreakpoint {
            tab: b.tab.title(),
            line: b.line + 1,
            condition: b.condition.clone(),
            disabled: !b.is_on,
        };
        let now: Vec<_> = self.breakpoints.iter().map(keep).collect();
        let kept = self.kept.as_mut().filter(|kept| **kept != now)?;
        kept.clone_from(&now);
        Some(now)
    }

    /// Computes what is shown, unless it is cached.
    pub(super) fn moment_state(&mut self) -> Option<&MomentState> {
        let examiner = self.examiner.as_mut()?;
        if self.seen.is_none() {
            let of = (&self.watches[..], &self.breakpoints[..]);
            self.seen = Some(MomentState::new(examiner, self.at, self.before, of, self.rows.take()));
        }
        self.seen.as_ref()
    }

    /// Clears what is shown, so that it is computed again.
    pub(super) fn forget(&mut self) {
        if let Some(seen) = self.seen.take() {
            self.rows = Some(seen.rows);
        }
    }

    /// Returns the breakpoints as tabs and lines, counted from 0.
    #[cfg(test)]
    pub(crate) fn lines(&self) -> Vec<(Tab, usize)> {
        self.breakpoints.iter().map(|b| (b.tab.clone(), b.line)).collect()
    }

    /// Returns whether there is a trace.
    pub(crate) fn is_on(&self) -> bool {
        self.examiner.is_some()
    }

    fn follow_texts(&mut self, session: &Session) {
        for (tab, text) in &mut self.texts {
            let now = session.text(tab);
            if now == text {
                continue;
            }
            self.breakpoints.retain_mut(|breakpoint| {
                if breakpoint.tab != *tab {
                    return true;
                }
                let line = follow_line(text, now, breakpoint.line);
                breakpoint.line = line.unwrap_or_default();
                line.is_some()
            });
            now.clone_into(text);
        }
    }

    /// Toggles the breakpoint at a line, counted from 0. A line without a statement moves it to the next line with
    /// one. Fails if there is none.
    pub(crate) fn toggle(&mut self, session: &Session, tab: &Tab, line: usize) -> Result<(), &'static str> {
        self.forget();
        let at = |line: usize| self.breakpoints.iter().position(|b| b.tab == *tab && b.line == line);
        match at(line) {
            Some(at) => drop(self.breakpoints.remove(at)),
            None => {
                let line = session.stop_line(tab, line).ok_or("No statement here or below: no breakpoint is set")?;
                if at(line).is_some() {
                    return Ok(());
                }
                self.texts.entry(tab.clone()).or_insert_with(|| session.text(tab).to_owned());
                let (tab, condition) = (tab.clone(), String::new());
                self.breakpoints.push(Breakpoint { tab, line, condition, is_on: true });
                self.breakpoints.sort_by_key(|b| (b.tab.title(), b.line));
            }
        }
        Ok(())
    }

    /// Applies an action of a key or a button. `caret`: its tab and line, from 0. Fails as [`Debugger::toggle`] does.
    pub(crate) fn act(
        &mut self,
        session: &Session,
        action: TraceAction,
        caret: Option<(Tab, usize)>,
    ) -> Result<(), &'static str> {
        if let (TraceAction::Breakpoint, Some((tab, line))) = (action, &caret) {
            return self.toggle(session, tab, *line);
        }
        let Some(examiner) = &mut self.examiner else { return Ok(()) };
        let traced = examiner.traced.clone();
        let end = |direction| travel::end(&traced.history, direction);
        let found = match action {
            TraceAction::Go(stride, direction) => travel::step(&traced.history, self.at, stride, direction),
            TraceAction::Continue(direction) => {
                examiner.continue_to_breakpoint(self.at, &self.breakpoints, direction).or_else(|| end(direction))
            }
            TraceAction::ToCursor(direction) => {
                caret.and_then(|(tab, line)| examiner.run_to(self.at, (&tab, line), direction))
            }
            TraceAction::End(direction) => end(direction),
            TraceAction::Breakpoint => None,
        };
        self.message = match (found, action) {
            (Some(at), _) if at != self.at => None,
            (_, TraceAction::ToCursor(Direction::Forward)) => Some("the line is not reached again"),
            (_, TraceAction::ToCursor(Direction::Back)) => Some("the line was not reached before"),
            (_, TraceAction::Go(_, Direction::Back) | TraceAction::Continue(Direction::Back)) => {
                Some("start of the trace")
            }
            _ => Some("end of the trace"),
        };
        if let Some(at) = found {
            self.go_to(at);
        }
        Ok(())
    }

    /// Goes to a moment.
    pub(crate) fn go_to(&mut self, at: usize) {
        if at != self.at {
            self.before = Some(std::mem::replace(&mut self.at, at));
            self.forget();
        }
        self.reveals = true;
    }

    /// Returns the tab and the line (from 0) of the current moment, in the text as edited; also its bytes if that is
    /// the text that was traced.
    fn place(&self, session: &Session) -> Option<(Tab, usize, Option<std::ops::Range<usize>>)> {
        let traced = &self.examiner.as_ref()?.traced;
        let (tab, line, range) = traced.place(traced.history.span(self.at)?)?;
        let (old, now) = (traced.text(&tab), session.text(&tab));
        if old == now {
            return Some((tab, line, Some(range)));
        }
        let line = follow_line(old, now, line)?;
        Some((tab, line, None))
    }

    /// Returns what the editor shows in a tab.
    pub(crate) fn marks(&self, session: &Session, tab: &Tab) -> Debug {
        let place = self.place(session).filter(|(of, ..)| of == tab);
        let of = self.breakpoints.iter().filter(|breakpoint| breakpoint.tab == *tab);
        Debug {
            line: place.as_ref().map(|(_, line, _)| *line),
            range: place.and_then(|(.., range)| range),
            breakpoints: of.map(|b| (b.line, b.is_on, !b.condition.trim().is_empty())).collect(),
        }
    }

    /// Returns the tab and line to scroll into view, once.
    pub(crate) fn take_reveal(&mut self, session: &Session) -> Option<(Tab, usize)> {
        let reveals = std::mem::take(&mut self.reveals);
        self.place(session).filter(|_| reveals).map(|(tab, line, _)| (tab, line))
    }
}

/// Returns whether a position in one trace is valid in the other: the same pixel and the same texts.
fn is_like(new: &Traced, known: &Traced) -> bool {
    let texts = |traced: &Traced| [Tab::Common, traced.tab.clone()].map(|tab| traced.text(&tab).to_owned());
    is_of_pixel(new, known) && new.tab == known.tab && texts(new) == texts(known)
}

fn is_of_pixel(new: &Traced, known: &Traced) -> bool {
    new.pass == known.pass && new.pixel == known.pixel && new.size == known.size
}
