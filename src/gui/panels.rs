//! The table of panels. A panel has its contents and a [`PanelRow`] in files of its own, and a line here.

use super::{
    actions::{Action, Entry, Group},
    buffers, channels, code,
    code::CodePanel,
    compare, costs, custom_uniforms,
    dock::{Contents, Heights},
    lab,
    lab::Lab,
    measures,
    passes::Passes,
    picture, recorder,
    recorder::Recorder,
    settings::Settings,
    sound, speed,
    thumbnails::Thumbnails,
    trace, transport,
    ui_output::UiOutput,
    viewport::Viewport,
};
use crate::session::Session;
use egui::{Frame, Margin, Rect, Ui};
use serde_json::Value;
use std::sync::Arc;

macro_rules! panels {
    ($($panel:ident: $row:expr $(, $state:ident: $type:ty)?;)*) => {
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub(super) enum Panel {
            $($panel,)*
        }

        /// A row for each panel, in the order of the enum.
        const PANELS: &[(Panel, PanelRow)] = &[$((Panel::$panel, $row)),*];

        /// The window's state that belongs to the open project. All of it is replaced when another project is opened.
        ///
        /// The code also keeps its editors per project ([`CodePanel`]); the layout of panels, how the picture fits its
        /// place and the search text belong to the user.
        #[derive(Default)]
        pub(super) struct ProjectUiState {
            $($(pub $state: $type,)?)*
            pub passes: Passes,
        }
    };
}

// A panel with its row, and its state if that belongs to the open project. The View menu has this order.
panels! {
    Picture: picture::PANEL;
    Code: code::PANEL;
    Uniforms: custom_uniforms::PANEL;
    Channels: channels::PANEL;
    Costs: costs::PANEL;
    Lab: lab::PANEL;
    Trace: trace::PANEL, debugger: trace::Debugger;
    Buffers: buffers::PANEL, buffers: buffers::Buffers;
    Compare: compare::PANEL, compare: compare::Compare;
    Speed: speed::PANEL, speed: speed::Speed;
    Measurements: measures::PANEL, measurements: measures::Measurements;
    Sound: sound::PANEL, sound: sound::Sound;
    Recorder: recorder::PANEL;
}

/// All that the window knows of a panel.
pub(super) struct PanelRow {
    /// The name in files.
    pub name: &'static str,
    /// The name in the window.
    pub title: &'static str,
    pub place: DefaultPlace,
    pub content: Content,
    /// Open by default.
    pub is_open: bool,
    /// The name, the title and the keys of the action that opens and closes it, and more words by which it is found.
    pub action: (&'static str, &'static str, &'static [&'static str], &'static str),
    /// Shows controls at the right end of its row.
    pub tools: Option<fn(&mut Ui, &mut PanelContext<'_>)>,
    /// The title that is shown, if it says more than the name.
    pub heading: Option<fn(&PanelContext<'_>) -> String>,
    /// The report for scripts, while it is open.
    pub report: Option<fn(&mut ProjectUiState, &Lab, &Session) -> Value>,
}

/// A panel's default place.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DefaultPlace {
    /// A place of its own, set in `dock/automatic.rs`.
    Own,
    /// Below the picture, where panels share a place as tabs.
    BelowPicture,
    /// Below the code, where panels share a place as tabs.
    BelowCode,
    /// The same, with more of the height, for pictures or plots.
    BelowCodeLarge,
}

/// The contents of a panel, and whether the panel needs a title row.
pub(super) enum Content {
    /// Within a margin that the panel fills.
    Within(Margin, fn(&mut Ui, &mut PanelContext<'_>)),
    /// With a row of its own by which the panel can be dragged, so that it needs no title row. Returns true if a drag
    /// of the row starts.
    WithRow(fn(&mut Ui, &mut PanelContext<'_>) -> bool),
}

/// The margin of most panels.
pub(super) const MARGIN: Margin = Margin { left: 8, right: 6, top: 2, bottom: 4 };

impl PanelRow {
    /// Returns the row of a panel that is closed by default and has no keys.
    pub(super) const fn new(name: &'static str, title: &'static str, place: DefaultPlace, content: Content) -> Self {
        let action = (name, title, &[] as &[&str], "");
        Self { name, title, place, content, is_open: false, action, tools: None, heading: None, report: None }
    }

    pub(super) const fn open_by_default(self) -> Self {
        Self { is_open: true, ..self }
    }

    /// Sets the title of the action in the palette and the help, its default keys, and more words by which it is
    /// found, in lower case.
    pub(super) const fn action(
        self,
        title: &'static str,
        keys: &'static [&'static str],
        synonyms: &'static str,
    ) -> Self {
        Self { action: (self.action.0, title, keys, synonyms), ..self }
    }

    pub(super) const fn tools(self, show: fn(&mut Ui, &mut PanelContext<'_>)) -> Self {
        Self { tools: Some(show), ..self }
    }

    pub(super) const fn heading(self, heading: fn(&PanelContext<'_>) -> String) -> Self {
        Self { heading: Some(heading), ..self }
    }

    pub(super) const fn report(self, report: fn(&mut ProjectUiState, &Lab, &Session) -> Value) -> Self {
        Self { report: Some(report), ..self }
    }
}

impl Panel {
    pub(super) fn all() -> impl Iterator<Item = Panel> {
        PANELS.iter().map(|(panel, _)| *panel)
    }

    pub(super) fn row(self) -> &'static PanelRow {
        &PANELS[self as usize].1
    }

    /// Returns the name in files.
    pub(super) fn name(self) -> &'static str {
        self.row().name
    }

    pub(super) fn named(name: &str) -> Option<Panel> {
        Panel::all().find(|panel| panel.name() == name)
    }

    /// Returns all names, for a message.
    pub(super) fn names() -> String {
        Panel::all().map(Panel::name).collect::<Vec<_>>().join(", ")
    }

    /// Returns the name in the window.
    pub(super) fn title(self) -> &'static str {
        self.row().title
    }

    /// Returns whether the panel's contents have a row by which it can be dragged, so that it needs no title row.
    pub(super) fn has_own_row(self) -> bool {
        matches!(self.row().content, Content::WithRow(_))
    }

    pub(super) const COUNT: usize = PANELS.len();

    /// Returns the action that opens and closes the panel of a row.
    pub(super) const fn action(index: usize) -> Entry {
        let (panel, row) = &PANELS[index];
        let (name, title, keys, synonyms) = row.action;
        Entry { action: Action::Panel(*panel), name, title, keys, group: Group::Window, synonyms }
    }
}

/// The parts of the window that panels show and change.
pub(super) struct PanelContext<'a> {
    pub viewport: &'a mut Viewport,
    pub code: &'a mut CodePanel,
    pub lab: &'a mut Lab,
    pub recorder: &'a mut Recorder,
    pub project_ui: &'a mut ProjectUiState,
    pub settings: &'a Settings,
    /// The point of the picture below the pointer in the newest frame, from 0 to 1.
    pub under_picture: Option<[f32; 2]>,
    pub thumbnails: &'a mut Thumbnails,
    /// Thumbnails of passes.
    pub live: &'a mut channels::Live,
    /// Called when there is something to show.
    pub wake: &'a Arc<dyn Fn() + Send + Sync>,
    pub session: &'a Session,
    pub out: &'a mut UiOutput,
}

impl Contents for PanelContext<'_> {
    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool {
        match panel.row().content {
            Content::WithRow(show) => show(ui, self),
            Content::Within(margin, show) => {
                Frame::NONE.inner_margin(margin).show(ui, |ui| {
                    ui.set_min_size(ui.available_size());
                    show(ui, self);
                });
                false
            }
        }
    }

    fn tools(&mut self, ui: &mut Ui, panel: Panel) {
        if let Some(show) = panel.row().tools {
            show(ui, self);
        }
    }

    fn title(&self, panel: Panel) -> String {
        panel.row().heading.map_or_else(|| panel.title().to_owned(), |heading| heading(self))
    }

    fn heights(&self) -> Heights {
        Heights {
            transport: transport::HEIGHT + Viewport::RIMS,
            uniforms: custom_uniforms::height(self.session),
            channels: channels::HEIGHT,
        }
    }

    fn place(&mut self, name: String, rect: Rect) {
        self.out.place(name, rect);
    }
}
