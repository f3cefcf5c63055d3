//! The table of actions.

use super::{
    Action, Entry, Group, LayoutAction, PictureAction, TimeAction, TraceAction,
    picture::{SCALES, SIZES},
};
use crate::{
    gui::{
        dock::{Panel, Side},
        editor::{EditorAction as Code, Motion, Way},
        geometry::Shape,
        settings::Theme,
    },
    session::trace::travel::{
        Direction::{self, Back, Forward},
        Stride,
    },
};

impl Action {
    /// Returns what the palette, the help and menus call it.
    pub fn title(self) -> &'static str {
        ACTIONS.iter().find(|e| e.action == self).map_or("", |e| e.title)
    }
}

const fn row(
    action: Action,
    name: &'static str,
    title: &'static str,
    keys: &'static [&'static str],
    group: Group,
) -> Entry {
    Entry { action, name, title, keys, group }
}

const fn code(action: Code, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(action), name, title, keys, Group::Code)
}

const fn go_on(
    stride: Stride,
    way: Direction,
    name: &'static str,
    title: &'static str,
    keys: &'static [&'static str],
) -> Entry {
    row(Action::Trace(TraceAction::Go(stride, way)), name, title, keys, Group::Trace)
}

const fn trace(action: TraceAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Trace(action), name, title, keys, Group::Trace)
}

const fn time(action: TimeAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Time(action), name, title, keys, Group::Picture)
}

const fn picture(action: PictureAction, name: &'static str, title: &'static str) -> Entry {
    row(Action::Picture(action), name, title, &[], Group::Picture)
}

const fn layout(action: LayoutAction, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Layout(action), name, title, keys, Group::Window)
}

/// A motion of the caret, and the same with Shift, which selects.
const fn go(motion: Motion, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(Code::Go(motion)), name, title, keys, Group::Caret)
}

const fn select(motion: Motion, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(Code::Select(motion)), name, title, keys, Group::Caret)
}

const fn caret(action: Code, name: &'static str, title: &'static str, keys: &'static [&'static str]) -> Entry {
    row(Action::Code(action), name, title, keys, Group::Caret)
}

/// A Mac moves by words with Option and to the ends of lines with Command.
const fn or_mac(keys: &'static [&'static str], mac: &'static [&'static str]) -> &'static [&'static str] {
    if cfg!(target_os = "macos") { mac } else { keys }
}

/// Keys are Shadertoy's where it has one, else those of VS Code. In the code, VS Code's come first: there Alt+Up moves
/// a line, and F5 plays and pauses wherever one is.
pub const ACTIONS: &[Entry] = &[
    row(Action::Save, "save", "Save", &["Ctrl+S"], Group::Project),
    row(Action::SaveAs, "save-as", "Save as a new folder", &["Ctrl+Shift+S"], Group::Project),
    row(Action::Open, "open", "Open a project: a file", &["Ctrl+O"], Group::Project),
    row(Action::OpenFolder, "open-folder", "Open a folder", &[], Group::Project),
    row(Action::New, "new", "New shader", &["Ctrl+N"], Group::Project),
    row(Action::Paste, "paste", "Open what is on the clipboard: Shadertoy JSON, GLSL or a path", &[], Group::Project),
    row(Action::Gallery, "gallery", "Gallery of presets", &["Ctrl+Shift+G"], Group::Project),
    row(Action::ResetOnReload, "reset-on-reload", "Reset when a file is reloaded, or no longer", &[], Group::Project),
    row(Action::AddCommon, "add-common", "Add Common, the text before every pass's", &[], Group::Project),
    row(Action::AddBuffer, "add-buffer", "Add a buffer", &[], Group::Project),
    row(Action::Quit, "quit", "Quit", &["Ctrl+Q"], Group::Project),
    row(Action::TogglePlay, "play", "Play or pause", &["Alt+Up", "F5"], Group::Picture),
    row(Action::Reset, "reset", "Reset time and buffers", &["Alt+Down", "Ctrl+Shift+F5"], Group::Picture),
    row(Action::StepBack, "step-back", "One frame back, buffers and all, then pause", &["Alt+,"], Group::Picture),
    row(Action::Step, "step", "One frame forward, then pause", &["Alt+."], Group::Picture),
    time(TimeAction::GoTo, "go-to-time", "Go to a time", &["Alt+G"]),
    time(TimeAction::Slower, "slower", "Time half as fast", &[]),
    time(TimeAction::Faster, "faster", "Time twice as fast", &[]),
    time(TimeAction::UsualSpeed, "usual-speed", "Time as fast as the clock's", &[]),
    time(TimeAction::FixedStep, "fixed-step", "Fixed step: every frame takes the same time, or no longer", &[]),
    time(TimeAction::LoopFrom, "loop-from", "Loop from this time", &["Alt+["]),
    time(TimeAction::LoopTo, "loop-to", "Loop to this time", &["Alt+]"]),
    time(TimeAction::LoopOff, "loop-off", "Loop no longer", &[]),
    time(TimeAction::KeepInputs, "keep-inputs", "After an edit the same frame from the same inputs, or no longer", &[]),
    row(Action::CompileOnSave, "compile-on-save", "Toggle compile on save only", &[], Group::Picture),
    row(Action::Compile, "compile", "Compile now", &["Alt+Enter", "Ctrl+Enter"], Group::Picture),
    row(
        Action::Screenshot,
        "save-picture",
        "Save a picture (PNG) of the shown pass",
        &["Ctrl+P", "F12"],
        Group::Picture,
    ),
    row(
        Action::Audit,
        "audit",
        "Check the picture: double precision, NaN, what GLSL leaves undefined",
        &["Ctrl+Shift+U"],
        Group::Picture,
    ),
    row(
        Action::FindNonfinite,
        "first-nan",
        "Find the first NaN or infinity: pass, frame, texel, line",
        &[],
        Group::Picture,
    ),
    row(
        Action::Record,
        "record-input",
        "Record input from frame 0, or end that and save it",
        &["Ctrl+Shift+R"],
        Group::Picture,
    ),
    row(
        Action::SaveTexels,
        "save-texels",
        "Save the shown pass's float texels (.npy)",
        &["Ctrl+Shift+E"],
        Group::Picture,
    ),
    row(Action::Fullscreen, "full-screen", "Picture alone, full screen", &["F11"], Group::Picture),
    row(Action::Present, "present", "Present: code over a picture that fills the window", &["F9"], Group::Picture),
    row(
        Action::Probe,
        "probe",
        "Probe expression: draw the value at the caret, or the picture again",
        &["Ctrl+Shift+I"],
        Group::Picture,
    ),
    row(
        Action::TracePixel,
        "trace-pixel",
        "Trace pixel: the next click on the picture says which (also Ctrl+Shift+click)",
        &["Ctrl+T"],
        Group::Picture,
    ),
    picture(PictureAction::Shape(Shape::Site), "picture-wide", "Picture shape: 16:9, as on the site"),
    picture(PictureAction::Shape(Shape::Fill), "picture-fill", "Picture shape: the view's"),
    picture(PictureAction::Scale(SCALES[0]), "picture-2x", "Picture size: twice the view's"),
    picture(PictureAction::Scale(SCALES[1]), "picture-usual", "Picture size: the view's"),
    picture(PictureAction::Scale(SCALES[2]), "picture-three-quarters", "Picture size: 3/4 of the view's"),
    picture(PictureAction::Scale(SCALES[3]), "picture-half", "Picture size: 1/2 of the view's"),
    picture(PictureAction::Scale(SCALES[4]), "picture-quarter", "Picture size: 1/4 of the view's"),
    picture(PictureAction::Scale(SCALES[5]), "picture-eighth", "Picture size: 1/8 of the view's"),
    picture(PictureAction::Size(SIZES[0]), "picture-256x144", "Picture size: always 256 × 144"),
    picture(PictureAction::Size(SIZES[1]), "picture-640x360", "Picture size: always 640 × 360"),
    picture(PictureAction::Size(SIZES[2]), "picture-800x450", "Picture size: always 800 × 450"),
    picture(PictureAction::Size(SIZES[3]), "picture-1280x720", "Picture size: always 1280 × 720"),
    picture(PictureAction::Size(SIZES[4]), "picture-1920x1080", "Picture size: always 1920 × 1080"),
    picture(PictureAction::Size(SIZES[5]), "picture-3840x2160", "Picture size: always 3840 × 2160"),
    picture(PictureAction::Size(SIZES[6]), "picture-512x512", "Picture size: always 512 × 512"),
    picture(PictureAction::Size(SIZES[7]), "picture-1024x1024", "Picture size: always 1024 × 1024"),
    picture(PictureAction::ResetUniforms, "reset-uniforms", "Uniforms: all back to their defaults"),
    picture(PictureAction::GoOn, "go-on", "A slow frame: go on drawing it"),
    picture(PictureAction::Smaller, "draw-smaller", "A slow frame: draw fewer pixels"),
    picture(PictureAction::LastGood, "last-good-code", "A slow frame: back to the last good code"),
    row(Action::Palette, "palette", "Command palette: every action by its name", &["Ctrl+Shift+P"], Group::Window),
    row(Action::Help, "help", "Help: all keys", &["F1"], Group::Window),
    row(Action::KeyFile, "keys", "Give actions other keys: the file for it", &[], Group::Window),
    row(Action::TabLeft, "tab-left", "Tab to the left", &["Alt+Left", "Ctrl+PageUp"], Group::Window),
    row(Action::TabRight, "tab-right", "Tab to the right", &["Alt+Right", "Ctrl+PageDown"], Group::Window),
    row(Action::NextPanel, "next-panel", "Keyboard to the next part of the window", &["F6"], Group::Window),
    row(
        Action::PreviousPanel,
        "previous-panel",
        "Keyboard to the part of the window before",
        &["Shift+F6"],
        Group::Window,
    ),
    row(Action::Lab, "lab", "Lab: speed against error", &["Ctrl+Shift+Y", "Ctrl+Shift+L"], Group::Window),
    row(Action::Passes, "passes", "Passes: add, rename, order, size, format, steps", &["Ctrl+Shift+B"], Group::Window),
    row(Action::UndoPasses, "undo-passes", "Undo the last change of passes or channels", &["Ctrl+Z"], Group::Window),
    row(
        Action::RedoPasses,
        "redo-passes",
        "Redo a change of passes or channels",
        &["Ctrl+Shift+Z", "Ctrl+Y"],
        Group::Window,
    ),
    row(Action::Costs, "costs", "What each pass costs", &["Ctrl+Shift+M"], Group::Window),
    row(Action::Panel(Panel::Picture), "picture-panel", "Panel: the picture", &[], Group::Window),
    row(Action::Panel(Panel::Code), "code-panel", "Panel: the code", &[], Group::Window),
    row(Action::Panel(Panel::Uniforms), "uniforms", "Panel: uniforms", &[], Group::Window),
    row(Action::Panel(Panel::Channels), "channels", "Panel: channels", &[], Group::Window),
    row(Action::Panel(Panel::Trace), "trace", "Panel: the way of a pixel", &["Ctrl+Shift+D"], Group::Window),
    row(
        Action::Panel(Panel::Buffers),
        "buffers",
        "Buffers: texels and numbers of every pass, and the render graph",
        &["Ctrl+Shift+T"],
        Group::Window,
    ),
    row(
        Action::Panel(Panel::Compare),
        "compare",
        "Compare with the last save, another project or a revision",
        &["Ctrl+Shift+O"],
        Group::Window,
    ),
    row(
        Action::Panel(Panel::Measurements),
        "measurements",
        "Measurements: the numbers of //@probe comments over time",
        &["Ctrl+Shift+J"],
        Group::Window,
    ),
    row(Action::UsualLayout, "usual-layout", "Every panel in its usual place", &[], Group::Window),
    layout(LayoutAction::Resize(Side::Left), "panel-narrower", "This panel: narrower", &["Ctrl+Shift+Alt+Left"]),
    layout(LayoutAction::Resize(Side::Right), "panel-wider", "This panel: wider", &["Ctrl+Shift+Alt+Right"]),
    layout(LayoutAction::Resize(Side::Up), "panel-lower", "This panel: lower", &["Ctrl+Shift+Alt+Up"]),
    layout(LayoutAction::Resize(Side::Down), "panel-higher", "This panel: higher", &["Ctrl+Shift+Alt+Down"]),
    layout(LayoutAction::Move(Side::Left), "panel-to-left", "This panel: to the left edge of the window", &[]),
    layout(LayoutAction::Move(Side::Right), "panel-to-right", "This panel: to the right edge of the window", &[]),
    layout(LayoutAction::Move(Side::Up), "panel-to-top", "This panel: to the top of the window", &[]),
    layout(LayoutAction::Move(Side::Down), "panel-to-bottom", "This panel: to the bottom of the window", &[]),
    layout(LayoutAction::Share, "panel-share", "This panel: into the place of the next one, as its tab", &[]),
    layout(LayoutAction::Close, "panel-close", "This panel: close", &[]),
    row(Action::NextTheme, "theme", "Dark, light, or what the system prefers", &[], Group::Window),
    row(Action::Theme(Theme::Dark), "theme-dark", "Theme: dark", &[], Group::Window),
    row(Action::Theme(Theme::Light), "theme-light", "Theme: light", &[], Group::Window),
    row(Action::Theme(Theme::System), "theme-system", "Theme: the system's", &[], Group::Window),
    row(Action::ZoomIn, "zoom-in", "Everything larger", &["Ctrl+Alt+=", "Ctrl+Alt++"], Group::Window),
    row(Action::ZoomOut, "zoom-out", "Everything smaller", &["Ctrl+Alt+-"], Group::Window),
    row(Action::ZoomReset, "zoom-usual", "Everything in its usual size", &["Ctrl+Alt+0"], Group::Window),
    row(Action::SettingsFile, "settings", "The file of settings", &[], Group::Window),
    row(Action::FontLarger, "code-larger", "Larger code", &["Ctrl++", "Ctrl+=", "Alt++", "Alt+="], Group::Window),
    row(Action::FontSmaller, "code-smaller", "Smaller code", &["Ctrl+-", "Alt+-"], Group::Window),
    row(Action::FontReset, "code-usual-size", "Code in its usual size", &["Ctrl+0"], Group::Window),
    row(Action::WordWrap, "word-wrap", "Wrap long lines of code, or not", &["Alt+Z"], Group::Window),
    row(Action::Find, "find", "Find", &["Ctrl+F"], Group::Search),
    row(Action::Replace, "replace", "Find and replace", &["Ctrl+H"], Group::Search),
    row(Action::FindEverywhere, "find-in-passes", "Find in all passes", &["Ctrl+Shift+F"], Group::Search),
    row(Action::FindNext, "find-next", "Next match", &["F3"], Group::Search),
    row(Action::FindPrevious, "find-previous", "Previous match", &["Shift+F3"], Group::Search),
    row(Action::GoToLine, "go-to-line", "Go to a line", &["Ctrl+G"], Group::Search),
    row(Action::NextProblem, "next-problem", "Next problem", &["F8"], Group::Search),
    row(Action::PreviousProblem, "previous-problem", "Previous problem", &["Shift+F8"], Group::Search),
    row(Action::FindCase, "find-case", "Upper and lower case count, or not", &["Alt+C"], Group::FindBar),
    row(Action::FindRegex, "find-regex", "Find a regular expression, or plain text", &["Alt+R"], Group::FindBar),
    row(Action::ReplaceAll, "replace-all", "Replace all matches", &["Ctrl+Alt+Enter"], Group::FindBar),
    trace(TraceAction::Continue(Forward), "continue", "On to the next breakpoint", &["F5"]),
    trace(TraceAction::Continue(Back), "continue-back", "Back to the breakpoint before", &["Alt+F5"]),
    go_on(Stride::Over, Forward, "step-over", "Step over calls", &["F10"]),
    go_on(Stride::Over, Back, "step-over-back", "Step back over calls", &["Alt+F10"]),
    go_on(Stride::Into, Forward, "step-into", "Step into a call", &["F11"]),
    go_on(Stride::Into, Back, "step-into-back", "Step back into a call", &["Alt+F11"]),
    go_on(Stride::Out, Forward, "step-out", "Step out of the call", &["Shift+F11"]),
    go_on(Stride::Out, Back, "step-out-back", "Back to where the call was made", &["Shift+Alt+F11"]),
    trace(TraceAction::ToCursor(Forward), "run-to-cursor", "On to the line of the caret", &["Ctrl+F10"]),
    trace(TraceAction::ToCursor(Back), "run-to-cursor-back", "Back to the line of the caret", &["Ctrl+Alt+F10"]),
    trace(TraceAction::End(Back), "trace-begin", "To the begin of the pixel's way", &["Ctrl+Alt+Home"]),
    trace(TraceAction::End(Forward), "trace-end", "To the end of the pixel's way", &["Ctrl+Alt+End"]),
    trace(TraceAction::Breakpoint, "breakpoint", "A breakpoint at the line of the caret, or none", &["F9"]),
    code(Code::Definition, "go-to-definition", "Go to where a name is declared (also Ctrl+click)", &["F12"]),
    code(Code::Uses, "list-uses", "List every use of a name", &["Shift+F12"]),
    code(Code::Rename, "rename", "Rename symbol", &["F2"]),
    code(Code::QuickFix, "quick-fix", "Fix the problem at the caret", &["Ctrl+."]),
    code(Code::Propose, "propose", "Propose names; Enter or Tab takes one", &["Ctrl+Space"]),
    code(Code::Signature, "signature", "Show what the call around the caret takes", &["Ctrl+Shift+Space"]),
    code(Code::ToggleComment, "toggle-comment", "Comment lines in or out", &["Ctrl+/"]),
    code(Code::ToggleBlockComment, "toggle-block-comment", "Comment a selection in or out: /* */", &["Shift+Alt+A"]),
    code(Code::MoveLines(Way::Up), "move-lines-up", "Move lines up", &["Alt+Up"]),
    code(Code::MoveLines(Way::Down), "move-lines-down", "Move lines down", &["Alt+Down"]),
    code(Code::CopyLines(Way::Up), "copy-lines-up", "Copy lines above", &["Shift+Alt+Up"]),
    code(Code::CopyLines(Way::Down), "copy-lines-down", "Copy lines below", &["Shift+Alt+Down"]),
    code(Code::DeleteLines, "delete-lines", "Delete lines", &["Ctrl+Shift+K"]),
    code(Code::Indent, "indent", "Indent, or go on to the next stop", &["Tab"]),
    code(Code::IndentLines, "indent-lines", "Indent lines", &["Ctrl+]"]),
    code(Code::Unindent, "unindent", "Unindent lines", &["Shift+Tab", "Ctrl+["]),
    code(Code::NewLine, "new-line", "New line", &["Enter", "Shift+Enter"]),
    code(Code::OpenLine(Way::Down), "line-below", "New line below", &["Ctrl+Enter"]),
    code(Code::OpenLine(Way::Up), "line-above", "New line above", &["Ctrl+Shift+Enter"]),
    code(Code::Delete(Motion::Left), "delete-left", "Delete the letter before", &["Backspace", "Shift+Backspace"]),
    code(Code::Delete(Motion::Right), "delete-right", "Delete the letter behind", &["Delete"]),
    code(
        Code::Delete(Motion::WordLeft),
        "delete-word-left",
        "Delete the word before",
        or_mac(&["Ctrl+Backspace"], &["Alt+Backspace"]),
    ),
    code(
        Code::Delete(Motion::WordRight),
        "delete-word-right",
        "Delete the word behind",
        or_mac(&["Ctrl+Delete"], &["Alt+Delete"]),
    ),
    code(Code::Cut, "cut", "Cut", &[]),
    code(Code::Copy, "copy", "Copy", &[]),
    code(Code::Paste, "paste-code", "Paste", &[]),
    code(Code::Undo, "undo", "Undo", &["Ctrl+Z"]),
    code(Code::Redo, "redo", "Redo", &["Ctrl+Shift+Z", "Ctrl+Y"]),
    code(Code::Fold, "fold", "Fold the block around the caret", &["Ctrl+Shift+["]),
    code(Code::Unfold, "unfold", "Unfold the block at the caret", &["Ctrl+Shift+]"]),
    code(Code::FoldAll, "fold-all", "Fold all blocks", &[]),
    code(Code::UnfoldAll, "unfold-all", "Unfold all blocks", &[]),
    caret(Code::AddNext, "add-next", "Select the word, then its next occurrence too", &["Ctrl+D"]),
    caret(Code::AddAll, "add-all", "Select every occurrence of the word", &["Ctrl+Shift+L", "Ctrl+F2"]),
    caret(Code::AddCaret(Way::Up), "add-caret-up", "One more caret above", &["Ctrl+Alt+Up"]),
    caret(Code::AddCaret(Way::Down), "add-caret-down", "One more caret below", &["Ctrl+Alt+Down"]),
    caret(Code::OneCaret, "one-caret", "Back to one caret", &["Escape"]),
    caret(Code::OtherBracket, "other-bracket", "To the matching bracket", &["Ctrl+Shift+\\"]),
    caret(Code::SelectAll, "select-all", "Select the whole text", &["Ctrl+A"]),
    caret(Code::SelectLine, "select-line", "Select the line", &["Ctrl+L"]),
    go(Motion::Left, "left", "To the left", &["Left"]),
    go(Motion::Right, "right", "To the right", &["Right"]),
    go(Motion::Lines(-1), "up", "Up a line", &["Up"]),
    go(Motion::Lines(1), "down", "Down a line", &["Down"]),
    go(Motion::WordLeft, "word-left", "A word to the left", or_mac(&["Ctrl+Left"], &["Alt+Left"])),
    go(Motion::WordRight, "word-right", "A word to the right", or_mac(&["Ctrl+Right"], &["Alt+Right"])),
    go(Motion::Home, "line-start", "To the line's start", or_mac(&["Home"], &["Home", "Ctrl+Left"])),
    go(Motion::End, "line-end", "To the line's end", or_mac(&["End"], &["End", "Ctrl+Right"])),
    go(Motion::Start, "text-start", "To the text's start", or_mac(&["Ctrl+Home"], &["Ctrl+Home", "Ctrl+Up"])),
    go(Motion::Finish, "text-end", "To the text's end", or_mac(&["Ctrl+End"], &["Ctrl+End", "Ctrl+Down"])),
    go(Motion::Pages(-1), "page-up", "Up a page", &["PageUp"]),
    go(Motion::Pages(1), "page-down", "Down a page", &["PageDown"]),
    select(Motion::Left, "select-left", "Select to the left", &["Shift+Left"]),
    select(Motion::Right, "select-right", "Select to the right", &["Shift+Right"]),
    select(Motion::Lines(-1), "select-up", "Select up a line", &["Shift+Up"]),
    select(Motion::Lines(1), "select-down", "Select down a line", &["Shift+Down"]),
    select(
        Motion::WordLeft,
        "select-word-left",
        "Select a word to the left",
        or_mac(&["Ctrl+Shift+Left"], &["Shift+Alt+Left"]),
    ),
    select(
        Motion::WordRight,
        "select-word-right",
        "Select a word to the right",
        or_mac(&["Ctrl+Shift+Right"], &["Shift+Alt+Right"]),
    ),
    select(
        Motion::Home,
        "select-line-start",
        "Select to the line's start",
        or_mac(&["Shift+Home"], &["Shift+Home", "Ctrl+Shift+Left"]),
    ),
    select(
        Motion::End,
        "select-line-end",
        "Select to the line's end",
        or_mac(&["Shift+End"], &["Shift+End", "Ctrl+Shift+Right"]),
    ),
    select(
        Motion::Start,
        "select-text-start",
        "Select to the text's start",
        or_mac(&["Ctrl+Shift+Home"], &["Ctrl+Shift+Home", "Ctrl+Shift+Up"]),
    ),
    select(
        Motion::Finish,
        "select-text-end",
        "Select to the text's end",
        or_mac(&["Ctrl+Shift+End"], &["Ctrl+Shift+End", "Ctrl+Shift+Down"]),
    ),
    select(Motion::Pages(-1), "select-page-up", "Select up a page", &["Shift+PageUp"]),
    select(Motion::Pages(1), "select-page-down", "Select down a page", &["Shift+PageDown"]),
];
