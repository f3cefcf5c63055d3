//! The panels there are.

use egui_tiles::TileId;

/// Height of a panel's title row.
pub const BAR: f32 = 27.0;

/// A direction in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
    Up,
    Down,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Panel {
    Picture,
    Code,
    Uniforms,
    Channels,
    Costs,
    Lab,
    Trace,
    Buffers,
    Compare,
    Measurements,
}

impl Panel {
    pub const ALL: [Panel; 10] = [
        Panel::Picture,
        Panel::Code,
        Panel::Uniforms,
        Panel::Channels,
        Panel::Costs,
        Panel::Lab,
        Panel::Trace,
        Panel::Buffers,
        Panel::Compare,
        Panel::Measurements,
    ];

    /// Returns what it is called where it is kept.
    pub fn name(self) -> &'static str {
        match self {
            Panel::Picture => "picture",
            Panel::Code => "code",
            Panel::Uniforms => "uniforms",
            Panel::Channels => "channels",
            Panel::Costs => "costs",
            Panel::Lab => "lab",
            Panel::Trace => "trace",
            Panel::Buffers => "buffers",
            Panel::Compare => "compare",
            Panel::Measurements => "measurements",
        }
    }

    pub fn named(name: &str) -> Option<Panel> {
        Panel::ALL.into_iter().find(|panel| panel.name() == name)
    }

    /// Returns what the window calls it.
    pub fn title(self) -> &'static str {
        match self {
            Panel::Picture => "Picture",
            Panel::Code => "Code",
            Panel::Uniforms => "Uniforms",
            Panel::Channels => "Channels",
            Panel::Costs => "Costs",
            Panel::Lab => "Lab",
            Panel::Trace => "Trace",
            Panel::Buffers => "Buffers",
            Panel::Compare => "Compare",
            Panel::Measurements => "Measurements",
        }
    }

    pub(super) fn is_open_at_first(self) -> bool {
        matches!(self, Panel::Picture | Panel::Code | Panel::Uniforms | Panel::Channels)
    }

    /// It has a row of its own, by which it can be moved: another with its title would take room for nothing.
    pub(super) fn has_own_row(self) -> bool {
        matches!(self, Panel::Picture | Panel::Code)
    }

    /// It shares a place under the picture with others that are looked into now and then.
    pub(super) fn is_aside(self) -> bool {
        matches!(self, Panel::Uniforms | Panel::Costs)
    }

    pub(super) fn tile(self) -> TileId {
        TileId::from_u64(self as u64 + 1)
    }
}
