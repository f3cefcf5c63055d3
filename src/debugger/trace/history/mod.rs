//! The execution of one pixel of a pass, recorded so that it can be stepped forwards and backwards.
//!
//! Owns the moments at which control reached a part of the text, and every write to one of the author's variables
//! between them: the value of a variable at any moment is reconstructed from these. Stepping is implemented in
//! `travel`.

mod iterations;
mod places;
mod record;
mod recorder;
mod values;

pub use record::{Call, History, Iteration, Moment, MomentKind, NamedValue, Value};
pub(super) use recorder::HistoryRecorder;
