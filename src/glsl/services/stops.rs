//! Statements at which a debugger can stop.

use super::analysis::Analysis;
use crate::statements::Statements;
use eddy_diag::{SourceId, Span};
use std::{collections::HashSet, ops::Range};

impl Analysis {
    /// Returns the start of the statement for a breakpoint in a line: the first that starts in the line, otherwise the
    /// one that continues in it, otherwise the next one of the text. `None` if there is no further one. `line` is its
    /// bytes.
    pub fn statement_for(&self, source: SourceId, line: Range<usize>) -> Option<usize> {
        let statements = Statements::new(&self.module, &self.origins, &self.names);
        let outer: HashSet<u32> = statements.list.iter().flatten().filter_map(|s| s.parent).collect();
        let (mut around, mut next): (Option<Span>, Option<Span>) = (None, None);
        for (index, statement) in statements.list.iter().enumerate() {
            let Some(statement) = statement else { continue };
            // A block only groups other statements, and the initialiser of a loop belongs to its head.
            let is_block = statement.head == statement.whole && outer.contains(&(index as u32));
            let head = statement.head;
            if head.source != source || statement.is_init || is_block {
                continue;
            }
            if head.start as usize >= line.start {
                next = Some(next.filter(|known| known.start <= head.start).unwrap_or(head));
            } else if head.end as usize > line.start {
                around = Some(around.filter(|known| known.start >= head.start).unwrap_or(head));
            }
        }
        let in_line = next.filter(|next| (next.start as usize) < line.end);
        in_line.or(around).or(next).map(|head| head.start as usize)
    }
}
