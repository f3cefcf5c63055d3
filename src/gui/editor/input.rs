//! From events to changes of a [`Buffer`].

use super::{buffer::Buffer, motion::Motion};
use egui::{Event, ImeEvent, Key, Modifiers};

/// The effects of a run of events besides changes of the buffer itself.
#[derive(Debug, Default)]
pub(super) struct Handled {
    /// The caret moved or the text changed: it should be in sight.
    pub follow_caret: bool,
    /// To be put on the clipboard.
    pub copied: Option<String>,
}

/// Feeds the events of a frame to the buffer. `preedit` is the text an input method is composing; `page` a page's
/// lines.
pub(super) fn handle(buffer: &mut Buffer, preedit: &mut String, page: usize, events: &[Event]) -> Handled {
    let mut handled = Handled::default();
    for event in events {
        let used = match event {
            Event::Text(text) | Event::Ime(ImeEvent::Commit(text)) => {
                preedit.clear();
                let typed = !text.is_empty() && text != "\n" && text != "\r";
                if typed {
                    buffer.insert(text);
                }
                typed
            }
            Event::Ime(ImeEvent::Preedit { text, .. }) => {
                let used = *text != *preedit;
                preedit.clone_from(text);
                used
            }
            Event::Ime(ImeEvent::DeleteSurrounding { before_chars, after_chars }) => {
                let at = buffer.selection().head;
                let text = buffer.text();
                let start = text[..at].char_indices().rev().take(*before_chars).last().map_or(at, |(i, _)| i);
                let end = text[at..].char_indices().nth(*after_chars).map_or(text.len(), |(i, _)| at + i);
                buffer.replace(start..end, "", super::history::Kind::Other);
                true
            }
            Event::Paste(text) => {
                buffer.paste(text);
                true
            }
            Event::Copy => {
                handled.copied = Some(buffer.text()[buffer.copied_range()].to_owned());
                false
            }
            Event::Cut => {
                let range = buffer.copied_range();
                handled.copied = Some(buffer.text()[range.clone()].to_owned());
                buffer.replace(range, "", super::history::Kind::Other);
                true
            }
            Event::Key { key, pressed: true, modifiers, .. } => handle_key(buffer, *key, *modifiers, page),
            _ => false,
        };
        handled.follow_caret |= used;
    }
    handled
}

fn handle_key(buffer: &mut Buffer, key: Key, m: Modifiers, page: usize) -> bool {
    // Words are Option's on a Mac and Ctrl's elsewhere; Command goes to the ends of lines there.
    let mac = cfg!(target_os = "macos");
    let by_word = if mac { m.alt } else { m.ctrl };
    let to_edge = mac && m.mac_cmd;
    if m.alt && !mac && !(m.shift && key == Key::ArrowDown) {
        return false;
    }
    let motion = match key {
        Key::ArrowLeft if to_edge => Motion::Home,
        Key::ArrowRight if to_edge => Motion::End,
        Key::ArrowUp if to_edge => Motion::Start,
        Key::ArrowDown if to_edge => Motion::Finish,
        Key::ArrowLeft if by_word => Motion::WordLeft,
        Key::ArrowRight if by_word => Motion::WordRight,
        Key::ArrowLeft => Motion::Left,
        Key::ArrowRight => Motion::Right,
        Key::ArrowDown if m.alt && m.shift => {
            buffer.duplicate_lines();
            return true;
        }
        Key::ArrowUp => Motion::Lines(-1),
        Key::ArrowDown => Motion::Lines(1),
        Key::PageUp => Motion::Lines(-(page as isize)),
        Key::PageDown => Motion::Lines(page as isize),
        Key::Home if m.command => Motion::Start,
        Key::End if m.command => Motion::Finish,
        Key::Home => Motion::Home,
        Key::End => Motion::End,
        _ => return handle_editing_key(buffer, key, m, by_word),
    };
    buffer.go(motion, m.shift);
    true
}

fn handle_editing_key(buffer: &mut Buffer, key: Key, m: Modifiers, by_word: bool) -> bool {
    match key {
        Key::Backspace => buffer.delete(if by_word { Motion::WordLeft } else { Motion::Left }),
        Key::Delete => buffer.delete(if by_word { Motion::WordRight } else { Motion::Right }),
        Key::Enter if !m.command => buffer.new_line(),
        Key::Tab if m.shift => buffer.unindent(),
        Key::Tab if !m.command => buffer.indent(),
        Key::Slash if m.command => buffer.toggle_comment(),
        Key::A if m.command => buffer.select(0, buffer.text().len()),
        Key::L if m.command => {
            let range = buffer.copied_range();
            buffer.select(range.start, range.end);
        }
        Key::Z if m.command && m.shift => return buffer.redo(),
        Key::Y if m.command => return buffer.redo(),
        Key::Z if m.command => return buffer.undo(),
        _ => return false,
    }
    true
}
