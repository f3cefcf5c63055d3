//! The way of one pixel through a pass, kept so that it can be gone forwards and backwards.
//!
//! Owns the moments at which control came to a part of the text, and every write to one of the author's variables
//! between them: what a variable held at any moment is found by these. How one moves in it is `travel`'s.

mod places;
mod record;
mod recorder;
mod turns;
mod values;

pub use record::{Call, History, Iteration, Moment, MomentKind, NamedValue, Value};
pub(super) use recorder::HistoryRecorder;
