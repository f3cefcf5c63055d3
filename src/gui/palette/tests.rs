//! Tests of the palette's order.

use super::*;
use crate::gui::{
    actions::{PictureAction, SIZES, TimeAction},
    editor::{EditorAction as Code, Vertical},
    panels::Panel,
    settings::Theme,
};
use crate::session::{Command, TransportCommand};

fn action(fit: &Fit<'_>) -> Option<Action> {
    match fit.choice {
        Choice::Action(action) => Some(action),
        Choice::Offer(_) => None,
    }
}

fn first(typed: &str) -> Action {
    let fits = fits(typed, &[], &[]);
    action(fits.first().unwrap_or_else(|| panic!("nothing for {typed}"))).unwrap()
}

#[test]
fn a_few_letters_find_an_action() {
    assert_eq!(first("play"), Action::TogglePlay);
    assert_eq!(first("wrap"), Action::WordWrap);
    assert_eq!(first("go line"), Action::GoToLine);
    assert_eq!(first("gtl"), Action::GoToLine);
    assert_eq!(first("full"), Action::Fullscreen);
    assert_eq!(first("FIND REPL"), Action::Replace);
    assert_eq!(first("open folder"), Action::OpenFolder);
    assert_eq!(first("light"), Action::Theme(Theme::Light));
    assert!(fits("qqq", &[], &[]).is_empty());
}

/// Words of other programs, which newcomers use.
#[test]
fn synonyms_find_an_action() {
    use Action as A;
    let mut wrong = Vec::new();
    for (typed, wanted) in [
        ("debug", A::Panel(Panel::Trace)),
        ("export", A::ExportJson),
        ("shortcuts", A::KeyFile),
        ("keybindings", A::KeyFile),
        ("preferences", A::Settings),
        ("options", A::Settings),
        ("profiler", A::Panel(Panel::Costs)),
        ("performance", A::Panel(Panel::Costs)),
        ("video", A::Record),
        ("screenshot", A::Screenshot),
        ("fullscreen", A::Fullscreen),
        ("examples", A::Gallery),
        ("import", A::Open),
        ("sliders", A::Panel(Panel::Uniforms)),
        ("search", A::Find),
        ("presentation", A::Present),
        ("4k", A::Picture(PictureAction::Size(SIZES[5]))),
        ("dark mode", A::Theme(Theme::Dark)),
        ("midi", A::Settings),
        ("osc", A::Settings),
        ("controllers", A::Settings),
        ("format", A::Code(Code::Format)),
        ("beautify", A::Code(Code::Format)),
        ("clang", A::Code(Code::Format)),
        ("outline", A::GoToSymbol),
        ("symbols", A::GoToSymbol),
        ("functions", A::GoToSymbol),
        ("duplicate lines", A::Code(Code::CopyLines(Vertical::Down))),
        ("snippet", A::Code(Code::Propose)),
        ("autocomplete", A::Code(Code::Propose)),
        ("intellisense", A::Code(Code::Propose)),
        ("uncomment", A::Code(Code::ToggleComment)),
        ("collapse", A::Code(Code::Fold)),
        ("expand", A::Code(Code::Unfold)),
        ("multicursor", A::Code(Code::AddNext)),
        ("refactor", A::Code(Code::Rename)),
        ("usages", A::Code(Code::Uses)),
        ("declaration", A::Code(Code::Definition)),
        ("lightbulb", A::Code(Code::QuickFix)),
        ("fix all", A::FixAll),
        ("errors", A::NextProblem),
        ("grep", A::FindEverywhere),
        ("substitute", A::Replace),
        ("softwrap", A::WordWrap),
        ("recompile", A::Compile),
        ("build", A::Compile),
        ("rewind", A::Reset),
        ("pause", A::TogglePlay),
        ("resume", A::TogglePlay),
        ("seek", A::Time(TimeAction::GoTo)),
        ("volume", A::Mute),
        ("exit", A::Quit),
        ("manual", A::Help),
        ("documentation", A::Help),
        ("watch", A::Probe),
        ("heat map", A::CountCost),
        ("publish", A::ExportPage),
        ("projector", A::Fullscreen),
        ("day mode", A::Theme(Theme::Light)),
        ("templates", A::Gallery),
        ("numpy", A::SaveTexels),
        ("layers", A::Passes),
    ] {
        let found = first(typed);
        if found != wanted {
            wrong.push(format!("{typed}: {found:?}"));
        }
    }
    assert_eq!(wrong, [""; 0]);
    assert_eq!(fits("profiler", &[], &[])[0].synonym, Some("profiler"));
    assert_eq!(fits("costs", &[], &[])[0].synonym, None, "its own title fits");
    let by = |typed: &str| fits(typed, &[], &[]).iter().filter_map(action).collect::<Vec<_>>();
    assert!(by("debug").contains(&A::TracePixel) && by("export").contains(&A::Screenshot));
}

#[test]
fn every_other_action_is_listed() {
    assert_eq!(fits("", &[], &[]).len(), ACTIONS.len() - 1);
    assert_eq!(action(&fits("", &[Action::Panel(Panel::Lab), Action::Help], &[])[0]), Some(Action::Panel(Panel::Lab)));
    for entry in ACTIONS.iter().filter(|e| e.action != Action::Palette) {
        assert_eq!(first(entry.title), entry.action, "{} is not first by its own title", entry.title);
    }
}

#[test]
fn project_offers_follow_the_actions() {
    let offer = |name: &str, title: &str| Offer {
        name: name.into(),
        title: title.into(),
        request: Command::Transport(TransportCommand::Play).into(),
    };
    let offers = [offer("show:Image", "Show pass: Image"), offer("recent:/x/waves", "Open recent: waves (/x)")];
    assert_eq!(fits_of("img", &offers).iter().map(|fit| fit.name).collect::<Vec<_>>(), ["show:Image"]);
    let all = fits("", &[], &offers);
    assert_eq!(all.len(), ACTIONS.len() + 1);
    assert_eq!(all.last().unwrap().name, "recent:/x/waves");
    assert_eq!(fits("waves", &[], &offers)[0].name, "recent:/x/waves");
    assert_eq!(fits("show image", &[], &offers)[0].name, "show:Image");
}
