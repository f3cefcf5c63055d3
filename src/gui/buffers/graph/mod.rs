//! The render graph as a picture: passes in the order in which they need each other, and what each reads.

mod draw;
mod layers;
mod layout;

pub(super) use draw::show;
