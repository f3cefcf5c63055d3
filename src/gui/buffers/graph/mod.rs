//! The render graph as a picture: passes in the order of their dependencies, and what each reads.

mod draw;
mod layers;
mod layout;

pub(super) use draw::show;
