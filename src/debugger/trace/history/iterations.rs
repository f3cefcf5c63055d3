//! The iterations of a loop.

use super::record::{History, Iteration, Moment, MomentKind, NamedValue};
use eddy_glsl::statements::StatementPoint;

impl History {
    /// Returns the innermost loop that contains a moment.
    fn loop_of(&self, moment: &Moment) -> Option<u32> {
        let statements = self.walkable.statements();
        let mut at = match moment.kind {
            // The head of a loop belongs to the loop.
            MomentKind::Iteration(_) | MomentKind::Test | MomentKind::Step => Some(moment.statement),
            MomentKind::Statement | MomentKind::Return => statements.get(moment.statement)?.parent,
        };
        while let Some(index) = at {
            let statement = statements.get(index)?;
            if statement.test.is_some() || statement.tests_first {
                return Some(index);
            }
            at = statement.parent;
        }
        None
    }

    /// Returns the iterations of the innermost loop around a moment. Empty outside of loops.
    pub fn iterations(&self, at: usize) -> Vec<Iteration> {
        let Some(moment) = self.moments.get(at) else { return Vec::new() };
        let Some(of) = self.loop_of(moment) else { return Vec::new() };
        let statements = self.walkable.statements();
        let mine = |other: &Moment| other.call == moment.call;
        let starts_loop =
            |other: &Moment| mine(other) && other.statement == of && matches!(other.kind, MomentKind::Statement);
        let start = self.moments[..=at].iter().rposition(starts_loop).unwrap_or(0);
        let mut found: Vec<Iteration> = Vec::new();
        // The current iteration: its first moment, and its last statement.
        let (mut first, mut last) = (start + 1, None);
        for (index, other) in self.moments.iter().enumerate().skip(start + 1).filter(|(_, other)| mine(other)) {
            let is_head = other.statement == of;
            if !statements.lies_in(other.statement, of) || (is_head && other.kind == MomentKind::Statement) {
                break;
            }
            match other.kind {
                MomentKind::Iteration(_) if is_head => {
                    found.extend(last.take().map(|last| Iteration { first, last, end: last }));
                    first = index;
                }
                MomentKind::Step if is_head => {
                    found.extend(last.take().map(|last| Iteration { first, last, end: index }));
                }
                MomentKind::Return => break,
                MomentKind::Statement if statements.get(other.statement).is_none_or(|s| s.is_init) => {}
                _ => last = Some(index),
            }
        }
        found.extend(last.map(|last| Iteration { first, last, end: last }));
        found
    }

    /// Returns the values of the function's variables at the end of an iteration, including those of the loop's body.
    pub fn iteration_values(&self, iteration: &Iteration) -> Vec<NamedValue> {
        let moment = &self.moments[iteration.last];
        let slots = self.calls[moment.call as usize].slots as usize;
        let mut found: Vec<NamedValue> = Vec::new();
        for (variable, slot) in self.locals_when(moment, StatementPoint::After).into_iter().rev() {
            if found.iter().all(|shown| shown.name != variable.name) {
                let words = self.words_at(iteration.end, variable, slots + slot.unwrap_or_default());
                found.push(NamedValue { name: variable.name.clone(), value: self.of(variable.ty, words) });
            }
        }
        found.reverse();
        found
    }
}
