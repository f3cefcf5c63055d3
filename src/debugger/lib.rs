//! Debugging of one pixel: the values that its program computes, and the place where an error occurs.
//!
//! Owns the fragment that is walked on the processor ([`fragment`]), its trace and history ([`trace`]), the first
//! difference from the device ([`divergence`]), the audit of precision and undefined values ([`audit`]), and the search
//! for the frame and the pass of the first NaN ([`nonfinite`]). Works on data that the engine read back for a draw, so
//! it needs no session; the command line uses it without one.

pub mod audit;
pub mod divergence;
mod fragment;
pub mod nonfinite;
pub mod trace;
