//! The page: the player and the project's description in one HTML text, escaped so that no part of the project is
//! parsed as markup.

use crate::data::ProjectData;
use base64::prelude::{BASE64_STANDARD, Engine as _};
use eddy_project::Project;
use sha2::{Digest as _, Sha256};

const PAGE: &str = include_str!("player/page.html");
const STYLE: &str = include_str!("player/player.css");
const SCRIPTS: [&str; 5] = [
    include_str!("player/programs.js"),
    include_str!("player/textures.js"),
    include_str!("player/frames.js"),
    include_str!("player/sound.js"),
    include_str!("player/page.js"),
];

/// Returns the whole page.
pub(crate) fn page(project: &Project, data: &ProjectData) -> String {
    let json = serde_json::to_string(data).expect("a description has texts for keys");
    let script = script();
    let style = STYLE.trim_end();
    let author = &project.info.author;
    let about = if project.info.description.is_empty() { &project.name } else { &project.info.description };
    let named = |name: &str, content: &str| match content {
        "" => String::new(),
        content => format!("<meta name=\"{name}\" content=\"{}\">\n", escaped(content)),
    };
    substituted(&[
        ("policy", &policy(&script, style)),
        ("generator", &format!("Eddy {}", env!("CARGO_PKG_VERSION"))),
        ("meta", &(named("author", author) + &named("description", about))),
        ("title", &escaped(&project.name)),
        ("style", style),
        ("project", &for_script(&json)),
        ("script", &script),
    ])
}

/// Returns the page with a text in place of each `{name}`; inserted texts are not searched again.
fn substituted(values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    let mut rest = PAGE;
    while let Some(at) = rest.find('{') {
        let (before, after) = rest.split_at(at);
        out.push_str(before);
        let end = after.find('}').unwrap_or(after.len() - 1);
        let name = &after[1..end];
        out.push_str(values.iter().find(|(known, _)| *known == name).map_or("", |(_, value)| value));
        rest = &after[end + 1..];
    }
    out + rest
}

/// Returns the content security policy: the page runs only its own script and style, which are identified by their
/// hashes, and has no network access (Content Security Policy Level 3). A video is played from memory.
fn policy(script: &str, style: &str) -> String {
    let hash = |text: &str| format!("'sha256-{}'", BASE64_STANDARD.encode(Sha256::digest(text)));
    format!(
        "default-src 'none'; script-src {}; style-src {}; img-src data:; media-src blob:; base-uri 'none'; \
         form-action 'none'",
        hash(script),
        hash(style)
    )
}

/// Returns the script of the player.
pub(crate) fn script() -> String {
    format!("(async()=>{{'use strict';\n{}}})();\n", SCRIPTS.map(compact).concat())
}

/// Returns a script without comments and redundant white space. A comment must be on a line of its own; quoted texts
/// are unchanged, and a regular expression must not contain spaces or quotes.
fn compact(script: &str) -> String {
    let lines = script.lines().map(str::trim_start).filter(|line| !line.is_empty() && !line.starts_with("//"));
    let text: Vec<char> = lines.flat_map(|line| line.chars().chain(['\n'])).collect();
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '$';
    let mut out = String::with_capacity(text.len());
    let mut quote = None;
    let mut is_escaped = false;
    for (i, &c) in text.iter().enumerate() {
        if let Some(mark) = quote {
            if c == mark && !is_escaped {
                quote = None;
            }
            is_escaped = c == '\\' && !is_escaped;
        } else if matches!(c, '\'' | '"' | '`') {
            (quote, is_escaped) = (Some(c), false);
        } else if c == ' ' {
            let (before, after) = (out.chars().last().unwrap_or('\n'), text.get(i + 1).copied().unwrap_or('\n'));
            let is_between_signs = before == after && matches!(before, '+' | '-');
            if !(is_word(before) && is_word(after) || is_between_signs) {
                continue;
            }
        }
        out.push(c);
    }
    out
}

/// Escapes JSON so that no HTML parser finds the end of its element, or a comment.
pub(crate) fn for_script(json: &str) -> String {
    json.replace('<', "\\u003c").replace('>', "\\u003e").replace('\u{2028}', "\\u2028").replace('\u{2029}', "\\u2029")
}

/// Escapes a text for the content of an element or for a quoted attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;").replace('\'', "&#39;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compacting_preserves_the_script() {
        let script =
            "// A note.\nconst a = b => `x ${b} \\` y`;\n  let c = 'it\\'s  a' + + d - -e;\n\nreturn a in c;\n";
        assert_eq!(compact(script), "const a=b=>`x ${b} \\` y`;\nlet c='it\\'s  a'+ +d- -e;\nreturn a in c;\n");
    }

    #[test]
    fn text_stays_text() {
        assert_eq!(escaped("<a href=\"'&'\">"), "&lt;a href=&quot;&#39;&amp;&#39;&quot;&gt;");
        assert_eq!(for_script("\"</script><!--\u{2028}\""), "\"\\u003c/script\\u003e\\u003c!--\\u2028\"");
    }
}
