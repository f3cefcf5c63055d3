//! The places of moments in the texts, and the moments of a place.

use super::record::{History, Moment, MomentKind};
use eddy_diag::{SourceId, Span};
use eddy_glsl::statements::Statement;

impl History {
    /// Returns the text at which control is.
    pub fn span(&self, at: usize) -> Option<Span> {
        let moment = self.moments.get(at)?;
        let statement = self.walkable.statements().get(moment.statement)?;
        Some(match moment.kind {
            MomentKind::Statement | MomentKind::Return => statement.head,
            MomentKind::Iteration(1) | MomentKind::Iteration(_) | MomentKind::Test => {
                statement.test.unwrap_or(statement.head)
            }
            MomentKind::Step => statement.step.unwrap_or(statement.head),
        })
    }

    /// Returns whether stepping stops at a moment: parts of a line at which it has already stopped are skipped.
    pub fn is_stop(&self, at: usize) -> bool {
        let Some(moment) = self.moments.get(at) else { return false };
        let Some(statement) = self.walkable.statements().get(moment.statement) else { return false };
        match moment.kind {
            MomentKind::Statement => !statement.is_init,
            MomentKind::Iteration(number) => number > 1 && statement.tests_first,
            MomentKind::Test | MomentKind::Return => true,
            MomentKind::Step => false,
        }
    }

    pub fn depth(&self, at: usize) -> u32 {
        self.moments.get(at).map_or(0, |moment| self.calls[moment.call as usize].depth)
    }

    /// Returns the statement for a line: the first that starts in it or below it, in a text.
    pub(in crate::trace) fn statement_from(&self, source: SourceId, from: u32) -> Option<u32> {
        let statements = self.walkable.statements().list.iter().enumerate();
        let starts = statements.filter_map(|(index, statement)| {
            let statement = statement.as_ref()?;
            let is_block = statement.head == statement.whole && self.is_block(index as u32);
            let is_there = statement.head.source == source && statement.head.start >= from;
            (is_there && !statement.is_init && !is_block).then_some((statement.head.start, index as u32))
        });
        starts.min().map(|(_, index)| index)
    }

    /// Returns whether a statement is a block, which only groups others.
    fn is_block(&self, index: u32) -> bool {
        let list = &self.walkable.statements().list;
        list.iter().flatten().any(|other| other.parent == Some(index))
    }

    pub(in crate::trace) fn statement_head(&self, index: u32) -> Option<Span> {
        self.walkable.statements().get(index).map(|statement| statement.head)
    }

    /// Returns the statement that is about to run.
    pub(in crate::trace) fn statement_of(&self, at: usize) -> Option<u32> {
        self.moments.get(at).map(|moment| moment.statement)
    }

    /// Returns the moments at which a comment at a byte of a text is reached: after the statement that ends before it
    /// in the same block or, if there is none, before the first one of the block.
    pub(in crate::trace) fn moments_of_comment(&self, source: SourceId, text: &str, byte: u32) -> Vec<usize> {
        let statements = self.walkable.statements();
        let holds = |span: &Span| span.source == source && span.start <= byte && byte < span.end;
        let Some(function) = statements.functions.iter().position(holds) else { return Vec::new() };
        let all = || {
            let list = statements.list.iter().enumerate();
            let own = list.filter_map(|(index, statement)| Some((index as u32, statement.as_ref()?)));
            own.filter(|(_, s)| s.function() as usize == function && s.whole.source == source && !s.is_init)
        };
        // The innermost statement around it, which is a block, a branch or a loop.
        let around = all().filter(|(_, s)| holds(&s.whole)).min_by_key(|(_, s)| s.whole.end - s.whole.start);
        let around = around.map(|(index, _)| index);
        let siblings = || all().filter(|(_, s)| s.parent == around);
        // Statements of the other half of a branch are not neighbours.
        let is_near =
            |s: &Statement| text.get(s.whole.end as usize..byte as usize).is_none_or(|between| !between.contains('}'));
        let before = siblings().filter(|(_, s)| s.whole.end <= byte && is_near(s)).max_by_key(|(_, s)| s.whole.end);
        let after = siblings().filter(|(_, s)| s.whole.start >= byte).min_by_key(|(_, s)| s.whole.start);
        let starts = |of: u32| {
            let is_it = move |moment: &Moment| moment.statement == of && moment.kind == MomentKind::Statement;
            self.moments.iter().enumerate().filter(move |(_, moment)| is_it(moment)).map(|(at, _)| at)
        };
        match (before, after) {
            (Some((index, _)), _) => starts(index).filter_map(|at| self.end_of_statement(at)).collect(),
            (None, Some((index, _))) => starts(index).collect(),
            (None, None) => Vec::new(),
        }
    }

    /// Returns the moment at which a statement, including nested ones, is done, given the moment at which it starts.
    fn end_of_statement(&self, at: usize) -> Option<usize> {
        let started = self.moments.get(at)?;
        let statements = self.walkable.statements();
        let is_after = |other: &Moment| {
            other.call == started.call
                && (other.kind == MomentKind::Return
                    || !statements.lies_in(other.statement, started.statement)
                    || (other.statement == started.statement && other.kind == MomentKind::Statement))
        };
        let after = self.moments[at + 1..].iter().position(is_after)?;
        Some(at + 1 + after)
    }
}
