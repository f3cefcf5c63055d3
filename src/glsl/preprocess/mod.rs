//! The preprocessor (section 3.4): directives and macros, from the texts of a pass to the tokens for the parser.
//!
//! Owns [`preprocess`], filling [`Origins`], and every message about directives, macros and characters. It reads the
//! texts in sequence as Shadertoy does (Common, then the pass's code, and in them the included texts): macros and open
//! conditionals carry over.
//!
//! Follows ANGLE, which compiles for every browser, where the specification is silent: an unknown name in an `#if` is
//! an error unless `&&` or `||` skips it; there is no pasting with `##`; a macro's name that occurs while the macro is
//! being expanded is never expanded.

mod characters;
mod condition;
mod define;
mod directive;
mod entry;
mod expand;
mod foreign;
mod lines;
mod macros;
mod misplaced;
mod preprocessed;
mod state;
mod tests;
mod unit;

#[cfg(test)]
pub(super) use directive::DIRECTIVES;
pub(super) use macros::MacroTable;
pub(super) use preprocessed::Preprocessed;
pub(super) use preprocessed::Tok;
pub(super) use unit::Unit;

use super::{ast::Interner, cancel::Cancel, pieces::Piece, report::Report, source::Dialect};
use state::Preprocessor;

/// Preprocesses the texts after those of `done`.
///
/// # Panics
/// If there are none left.
pub(super) fn preprocess(
    pieces: &[Piece<'_>],
    (unit, dialect, cancel): (Unit, Dialect, Cancel<'_>),
    mut done: Preprocessed,
    names: &mut Interner,
    report: &mut Report,
) -> Preprocessed {
    done.reopen();
    let mut all = Preprocessor::new(pieces, (unit, dialect, cancel), done, names, report);
    all.run(unit);
    Preprocessed {
        tokens: all.tokens,
        origins: all.origins,
        macros: all.table,
        pieces: pieces.len(),
        is_cut: all.is_cut,
        has_line_numbers: all.line.was_asked,
        is_stopped: all.stopped,
    }
}
