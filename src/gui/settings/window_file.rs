//! `window.toml`: the window's place and layout, saved between runs.

use crate::gui::{config_file::write, dock::Node, panels::Panel};
use crate::{diag::LineIndex, project::confine};
use std::{collections::BTreeSet, path::PathBuf};
use toml_edit::{Array, DocumentMut, Item, Value};

const NAME: &str = "window.toml";
const HEADER: &str = "# Window state of Eddy when it was last closed. Delete this file to reset the layout.\n";
const KEYS: [&str; 7] = ["width", "height", "x", "y", "maximized", "open", "layout"];

/// The window's place, in the system's points.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct WindowPlace {
    pub size: Option<(f64, f64)>,
    /// The corner of its frame in physical pixels, if the system reports it.
    pub corner: Option<(i32, i32)>,
    pub is_maximized: bool,
}

/// The sizes that the window had while it was not maximised, with its corner then.
///
/// A window system reports the maximised state before or after the new size: the newest size may be the screen's.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct RestoredSizes {
    newest: Option<WindowPlace>,
    before: Option<WindowPlace>,
}

impl RestoredSizes {
    pub(crate) fn note(&mut self, place: WindowPlace) {
        if self.newest.is_none_or(|newest| newest.size != place.size) {
            self.before = self.newest;
        }
        self.newest = Some(place);
    }

    /// Returns the newest place with a different size.
    pub(crate) fn other_than(&self, size: (f64, f64)) -> Option<WindowPlace> {
        [self.newest, self.before].into_iter().flatten().find(|place| place.size != Some(size))
    }
}

/// The saved state of the window.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct WindowState {
    pub place: WindowPlace,
    /// The panels that are open.
    pub open: Option<BTreeSet<Panel>>,
    /// The layout that the user has made.
    pub layout: Option<Node>,
}

/// The file.
#[derive(Debug)]
pub(crate) struct WindowFile {
    /// `None` if the system has no folder for it.
    path: Option<PathBuf>,
    /// The state as last read or written.
    known: WindowState,
}

impl WindowFile {
    /// `folder`: for state saved between runs.
    pub(crate) fn new(folder: Option<PathBuf>) -> Self {
        Self { path: folder.map(|folder| folder.join(NAME)), known: WindowState::default() }
    }

    /// Reads the file, and returns the state and the errors in it, one line each; a valid entry counts despite errors
    /// in others.
    pub(crate) fn read(&mut self) -> (WindowState, Vec<String>) {
        let Some(path) = &self.path else { return Default::default() };
        let text = match confine::read_state_toml(path) {
            Ok(Some(text)) => text,
            Ok(None) => return Default::default(),
            Err(error) => return (WindowState::default(), vec![format!("{}: {error}", path.display())]),
        };
        let (state, errors) = read(&text);
        self.known = state.clone();
        let with_place = |(line, what): (usize, String)| format!("{}:{line}: {what}", path.display());
        (state, errors.into_iter().map(with_place).collect())
    }

    pub(crate) fn known(&self) -> &WindowState {
        &self.known
    }

    /// Writes the file if the state has changed.
    pub(crate) fn save_if_changed(&mut self, state: WindowState) {
        let Some(path) = &self.path else { return };
        if state == self.known {
            return;
        }
        match write(path, &text(&state)) {
            Ok(()) => self.known = state,
            // A failure is harmless now: only the next start lacks the state.
            Err(error) => log::warn!("{}: {error}", path.display()),
        }
    }
}

fn text(state: &WindowState) -> String {
    let WindowState { place, open, layout } = state;
    let mut document = DocumentMut::new();
    let mut set = |name: &str, value: Value| drop(document.insert(name, Item::Value(value)));
    if let Some((width, height)) = place.size {
        set("width", width.round().into());
        set("height", height.round().into());
    }
    if let Some((x, y)) = place.corner {
        set("x", i64::from(x).into());
        set("y", i64::from(y).into());
    }
    if place.is_maximized {
        set("maximized", true.into());
    }
    if let Some(open) = open {
        set("open", Value::Array(open.iter().map(|panel| panel.name()).collect::<Array>()));
    }
    if let Some(layout) = layout {
        set("layout", layout.to_value());
    }
    format!("{HEADER}{document}")
}

fn read(text: &str) -> (WindowState, Vec<(usize, String)>) {
    let mut state = WindowState::default();
    let mut errors = Vec::new();
    let lines = LineIndex::new(text);
    let document = match toml_edit::Document::parse(text) {
        Ok(document) => document,
        Err(error) => {
            let line = lines.line(error.span().map_or(0, |span| span.start));
            return (state, vec![(line, error.message().trim_end().to_owned())]);
        }
    };
    let table = document.as_table();
    let mut wrong = |name: &str, what: String| {
        let start = table.key(name).and_then(toml_edit::Key::span).map_or(0, |span| span.start);
        errors.push((lines.line(start), what));
    };
    for (name, _) in table.iter().filter(|(name, _)| !KEYS.contains(name)) {
        wrong(name, format!("unknown key \"{name}\"; the keys are {}", KEYS.join(", ")));
    }
    let value = |name: &str| table.get(name).and_then(Item::as_value);
    let number = |name: &str| value(name).and_then(|v| v.as_float().or_else(|| v.as_integer().map(|n| n as f64)));
    let is_size = |n: &f64| (100.0..=100_000.0).contains(n);
    state.place.size = number("width").filter(is_size).zip(number("height").filter(is_size));
    let whole = |name: &str| value(name)?.as_integer().and_then(|n| i32::try_from(n).ok());
    state.place.corner = whole("x").zip(whole("y"));
    state.place.is_maximized = value("maximized").and_then(Value::as_bool).unwrap_or(false);
    if let Some(list) = value("open") {
        let names = list.as_array().map(|list| list.iter().filter_map(Value::as_str).collect::<Vec<_>>());
        for name in names.iter().flatten().filter(|name| Panel::named(name).is_none()) {
            let all = Panel::names();
            wrong("open", format!("unknown panel \"{name}\"; the panels are {all}"));
        }
        state.open = names.map(|names| names.into_iter().filter_map(Panel::named).collect());
    }
    match value("layout").map(Node::from_value) {
        Some(Ok(node)) => state.layout = Some(node),
        Some(Err(what)) => wrong("layout", format!("the default layout is used: {what}")),
        None => {}
    }
    (state, errors)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> WindowState {
        let left = vec![
            (Node::Panel(Panel::Picture), 0.75),
            (Node::Tabs(vec![Node::Panel(Panel::Uniforms), Node::Panel(Panel::Costs)], 1), 0.25),
        ];
        WindowState {
            place: WindowPlace { size: Some((1300.0, 800.0)), corner: Some((-10, 20)), is_maximized: true },
            open: Some(BTreeSet::from([Panel::Picture, Panel::Code, Panel::Costs])),
            layout: Some(Node::Row(vec![(Node::Column(left), 0.5), (Node::Panel(Panel::Code), 0.5)])),
        }
    }

    #[test]
    fn a_maximised_window_restores_its_previous_size() {
        let place =
            |width: f64, x| WindowPlace { size: Some((width, 600.0)), corner: Some((x, 0)), is_maximized: false };
        let mut sizes = RestoredSizes::default();
        assert_eq!(sizes.other_than((1920.0, 600.0)), None);
        sizes.note(place(900.0, 5));
        sizes.note(place(940.0, 6));
        sizes.note(place(940.0, 7));
        assert_eq!(sizes.other_than((1920.0, 600.0)), Some(place(940.0, 7)));
        // The screen's size arrived before the maximised state.
        sizes.note(place(1920.0, 0));
        assert_eq!(sizes.other_than((1920.0, 600.0)), Some(place(940.0, 7)));
    }

    #[test]
    fn window_state_round_trips() {
        let folder = tempfile::tempdir().unwrap();
        let mut file = WindowFile::new(Some(folder.path().join("eddy")));
        assert_eq!(file.read(), (WindowState::default(), vec![]));
        file.save_if_changed(example());
        let text = std::fs::read_to_string(folder.path().join("eddy").join(NAME)).unwrap();
        assert!(text.contains("layout = { row = [{ column = [\"picture\", { tabs = "), "{text}");
        let mut next = WindowFile::new(Some(folder.path().join("eddy")));
        assert_eq!(next.read(), (example(), vec![]));
    }

    #[test]
    fn invalid_entries_are_reported_and_the_rest_is_read() {
        let text = "width = 900.0\nheight = 600\nwidht = 3\nopen = [\"code\", \"cdoe\"]\n\
                    layout = { row = [\"code\", \"code\"] }\nx = 1\n";
        let (state, errors) = read(text);
        assert_eq!(state.place, WindowPlace { size: Some((900.0, 600.0)), ..WindowPlace::default() });
        assert_eq!(state.open, Some(BTreeSet::from([Panel::Code])));
        assert_eq!(state.layout, None);
        let lines: Vec<usize> = errors.iter().map(|(line, _)| *line).collect();
        assert_eq!(lines, [3, 4, 5], "{errors:?}");
        assert!(errors[2].1.ends_with("a panel is listed twice"), "{errors:?}");
        let (state, errors) = read("x = \n");
        assert_eq!((state, errors.len()), (WindowState::default(), 1));
    }

    #[test]
    fn window_files_of_earlier_versions_are_read_and_written_the_same() {
        for file in [
            include_str!("../../../tests/saved/window/plain.toml"),
            include_str!("../../../tests/saved/window/layout.toml"),
        ] {
            let (state, errors) = read(file);
            assert_eq!(errors, []);
            assert_eq!(text(&state), file);
        }
    }
}
