//! Removes names of people, machines and folders from the texts of a report: drivers and the system put them into their
//! errors.

use crate::cli::doctor::hostname;
use serde_json::Value;
use std::env;

/// The names that must not be in a report.
pub(super) struct Names(Vec<String>);

/// Shorter names are those of units and variables.
const MIN_LENGTH: usize = 2;

impl Names {
    /// Returns the names of the user and of the machine.
    pub(super) fn of_this_machine() -> Self {
        let variables = ["USER", "LOGNAME", "USERNAME", "HOSTNAME", "COMPUTERNAME"].map(|name| env::var(name).ok());
        let home = dirs::home_dir().and_then(|home| Some(home.file_name()?.to_str()?.to_owned()));
        Self::of(variables.into_iter().chain([home, hostname()]).flatten())
    }

    pub(super) fn of(names: impl IntoIterator<Item = String>) -> Self {
        Self(names.into_iter().map(|name| name.to_lowercase()).filter(|name| name.len() >= MIN_LENGTH).collect())
    }

    /// Removes the names and absolute paths from all texts of a value. Keys are Eddy's own.
    pub(super) fn remove_from(&self, value: &mut Value) {
        match value {
            Value::String(text) => *text = self.removed(text),
            Value::Array(items) => items.iter_mut().for_each(|item| self.remove_from(item)),
            Value::Object(fields) => fields.values_mut().for_each(|field| self.remove_from(field)),
            Value::Null | Value::Bool(_) | Value::Number(_) => {}
        }
    }

    fn removed(&self, text: &str) -> String {
        let mut out = String::with_capacity(text.len());
        let is_end = |c: char| c.is_whitespace() || "\"'`()[]<>,;".contains(c);
        for part in text.split_inclusive(is_end) {
            let word = part.trim_end_matches(is_end);
            if is_absolute(word) {
                out.push_str("<path>");
            } else {
                self.push_word(&mut out, word);
            }
            out.push_str(&part[word.len()..]);
        }
        out
    }

    /// Appends a word, with `<name>` in place of each part that is one of the names.
    fn push_word(&self, out: &mut String, word: &str) {
        let is_end = |c: char| !c.is_alphanumeric() && c != '-' && c != '_';
        for part in word.split_inclusive(is_end) {
            let name = part.trim_end_matches(is_end);
            out.push_str(if self.0.contains(&name.to_lowercase()) { "<name>" } else { name });
            out.push_str(&part[name.len()..]);
        }
    }
}

/// Returns whether a word is or contains an absolute path of Unix or Windows, or one in the home folder.
fn is_absolute(word: &str) -> bool {
    let bytes = word.as_bytes();
    let is_drive = |at: usize| {
        bytes[at] == b':'
            && at > 0
            && bytes[at - 1].is_ascii_alphabetic()
            && matches!(bytes.get(at + 1), Some(b'\\' | b'/'))
    };
    let is_root = |at: usize| {
        bytes[at] == b'/' && bytes.get(at + 1).is_some_and(|next| next.is_ascii_alphanumeric() || b"._~-".contains(next))
            // Not `24/7`, `n/a` or `KHR/EXT`, but `file:///x` and `name=/x`.
            && (at == 0 || !bytes[at - 1].is_ascii_alphanumeric())
    };
    word.starts_with("~/") || word.starts_with("\\\\") || (0..bytes.len()).any(|at| is_drive(at) || is_root(at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_paths_are_removed() {
        let names = Names::of(["Ada".into(), "box-7".into(), "m".into()]);
        for (text, expected) in [
            ("cannot open /home/ada/x.spv: no", "cannot open <path> no"),
            ("the file \"C:\\Users\\Ada\\x.dll\" of ada@box-7", "the file \"<path>\" of <name>@<name>"),
            ("file:///usr/lib/x.so (n/a, 3/4 of it, some)", "<path> (n/a, 3/4 of it, some)"),
            ("NVIDIA GeForce RTX 4090/PCIe/SSE2", "NVIDIA GeForce RTX 4090/PCIe/SSE2"),
            ("adapter Adapt 3 m", "adapter Adapt 3 m"),
            ("~/x \\\\server\\x [/x]", "<path> <path> [<path>]"),
        ] {
            assert_eq!(names.removed(text), expected);
        }
        let mut value = serde_json::json!({ "a": ["/tmp/x", 1, { "b": "ADA" }] });
        names.remove_from(&mut value);
        assert_eq!(value, serde_json::json!({ "a": ["<path>", 1, { "b": "<name>" }] }));
    }
}
