//! The panels of the window.

use egui_tiles::TileId;

/// The height of a panel's title row.
pub(crate) const BAR: f32 = 27.0;

/// A direction in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    Left,
    Right,
    Up,
    Down,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Panel {
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
    Sound,
    Recorder,
}

/// The names of a panel and its default place.
struct Entry {
    panel: Panel,
    /// The name in files.
    name: &'static str,
    /// The name in the window.
    title: &'static str,
    /// The panel is open by default.
    is_open: bool,
    place: DefaultPlace,
}

/// A panel's default place.
#[derive(Clone, Copy, PartialEq, Eq)]
enum DefaultPlace {
    /// A place of its own, set in `automatic.rs`.
    Own,
    /// Below the picture, where panels share a place as tabs.
    BelowPicture,
    /// Below the code, where panels share a place as tabs.
    BelowCode,
}

const fn row(panel: Panel, name: &'static str, title: &'static str, is_open: bool, place: DefaultPlace) -> Entry {
    Entry { panel, name, title, is_open, place }
}

/// A row for each panel, in the order of the enum, which is also that of the View menu.
const PANELS: [Entry; 12] = [
    row(Panel::Picture, "picture", "Picture", true, DefaultPlace::Own),
    row(Panel::Code, "code", "Code", true, DefaultPlace::Own),
    row(Panel::Uniforms, "uniforms", "Uniforms", true, DefaultPlace::BelowPicture),
    row(Panel::Channels, "channels", "Channels", true, DefaultPlace::Own),
    row(Panel::Costs, "costs", "Costs", false, DefaultPlace::BelowPicture),
    row(Panel::Lab, "lab", "Lab", false, DefaultPlace::Own),
    row(Panel::Trace, "trace", "Trace", false, DefaultPlace::BelowCode),
    row(Panel::Buffers, "buffers", "Buffers", false, DefaultPlace::BelowCode),
    row(Panel::Compare, "compare", "Compare", false, DefaultPlace::BelowCode),
    row(Panel::Measurements, "measurements", "Measurements", false, DefaultPlace::BelowCode),
    row(Panel::Sound, "sound", "Sound", false, DefaultPlace::BelowCode),
    row(Panel::Recorder, "recorder", "Recorder", false, DefaultPlace::BelowCode),
];

impl Panel {
    pub(crate) fn all() -> impl Iterator<Item = Panel> {
        PANELS.iter().map(|entry| entry.panel)
    }

    fn entry(self) -> &'static Entry {
        &PANELS[self as usize]
    }

    /// Returns the name in files.
    pub(crate) fn name(self) -> &'static str {
        self.entry().name
    }

    pub(crate) fn named(name: &str) -> Option<Panel> {
        Panel::all().find(|panel| panel.name() == name)
    }

    /// Returns all names, for a message.
    pub(crate) fn names() -> String {
        PANELS.map(|entry| entry.name).join(", ")
    }

    /// Returns the name in the window.
    pub(crate) fn title(self) -> &'static str {
        self.entry().title
    }

    pub(super) fn is_open_by_default(self) -> bool {
        self.entry().is_open
    }

    /// Returns whether the panel's contents have a row by which it can be dragged, so that it needs no title row.
    pub(super) fn has_own_row(self) -> bool {
        matches!(self, Panel::Picture | Panel::Code)
    }

    pub(super) fn is_below_picture(self) -> bool {
        self.entry().place == DefaultPlace::BelowPicture
    }

    pub(super) fn is_below_code(self) -> bool {
        self.entry().place == DefaultPlace::BelowCode
    }

    pub(super) fn tile(self) -> TileId {
        TileId::from_u64(self as u64 + 1)
    }
}
