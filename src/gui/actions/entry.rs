//! A row of the table of actions.

use super::{Action, LayoutAction, TraceAction};

/// The section of the help for an action, and when its keys are active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Group {
    Project,
    Picture,
    Window,
    Search,
    /// While the find bar is open.
    FindBar,
    /// While the panel of a traced pixel is open.
    Trace,
    /// While the code has the keyboard focus; these take precedence over all others.
    Code,
    Caret,
}

impl Group {
    pub(crate) const ALL: [Group; 8] = [
        Group::Project,
        Group::Picture,
        Group::Window,
        Group::Search,
        Group::FindBar,
        Group::Trace,
        Group::Code,
        Group::Caret,
    ];

    pub(crate) fn title(self) -> &'static str {
        match self {
            Group::Project => "Project",
            Group::Picture => "Picture",
            Group::Window => "Window",
            Group::Search => "Find",
            Group::FindBar => "While the find bar is open",
            Group::Trace => "While the Trace panel is open",
            Group::Code => "Code editor",
            Group::Caret => "Caret and selection",
        }
    }
}

/// An action with its names and its default keys.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry {
    pub action: Action,
    /// The name in the key file.
    pub name: &'static str,
    /// The title in the palette and in the help.
    pub title: &'static str,
    pub keys: &'static [&'static str],
    pub group: Group,
    /// More words by which the palette finds it, in lower case: its names in other programs.
    pub synonyms: &'static str,
}

impl Entry {
    pub(crate) const fn found_by(self, synonyms: &'static str) -> Entry {
        Entry { synonyms, ..self }
    }

    /// Returns whether the action repeats while its key is held down.
    pub(crate) fn repeats(&self) -> bool {
        use Action as A;
        let again = [
            A::Step,
            A::StepBack,
            A::FontLarger,
            A::FontSmaller,
            A::ZoomIn,
            A::ZoomOut,
            A::FindNext,
            A::FindPrevious,
            A::NextProblem,
            A::NextPanel,
        ];
        matches!(self.action, A::Code(_) | A::Trace(TraceAction::Go(..)) | A::Layout(LayoutAction::Resize(_)))
            || again.contains(&self.action)
    }
}

#[cfg(test)]
mod tests {
    use crate::gui::{
        actions::{ACTIONS, Action},
        panels::Panel,
    };

    #[test]
    fn actions_of_panels_have_their_names() {
        let of = |panel| Action::Panel(panel).title();
        assert!(Panel::all().all(|panel| of(panel).starts_with(&format!("Panel: {}", panel.title()))));
    }

    /// People look for what they want to do, so the verb comes first: "Open settings file", not "The file of
    /// settings".
    #[test]
    fn titles_start_with_a_verb() {
        let never = ["a", "all", "an", "back", "every", "in", "on", "one", "the", "this", "to", "what"];
        for entry in ACTIONS {
            let first = entry.title.split([' ', ':']).next().unwrap_or_default();
            assert!(first.starts_with(char::is_uppercase), "{}", entry.title);
            assert!(!never.contains(&first.to_lowercase().as_str()), "{}", entry.title);
            assert!(!entry.title.ends_with('.') && !entry.title.contains(", or "), "{}", entry.title);
            assert!(entry.synonyms.chars().all(|c| c.is_lowercase() || !c.is_alphabetic()), "{}", entry.synonyms);
        }
    }
}
