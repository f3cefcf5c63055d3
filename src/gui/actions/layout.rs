//! Owns what keys and the palette can ask of the panel that has the keyboard.

use crate::gui::dock::Side;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayoutAction {
    /// Narrower, wider, lower, higher: to the left, to the right, up, down.
    Resize(Side),
    /// To an edge of the window.
    Move(Side),
    /// Into the place of the panel that comes next.
    Share,
    Close,
}
