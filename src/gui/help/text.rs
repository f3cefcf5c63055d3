//! The text of the help: sections of pages in `docs`, written in a subset of Markdown.

/// The pages, in the order of the help.
const PAGES: [&str; 2] = [include_str!("../../../docs/using.md"), include_str!("../../../docs/debugging.md")];

/// The section with a button for the page with the bookmarklet.
pub(super) const SHADERTOY: &str = "Shadertoy";

/// A part of the help.
pub(super) struct Section {
    pub title: String,
    pub paragraphs: Vec<Paragraph>,
}

#[derive(Debug, PartialEq, Eq)]
pub(super) enum Paragraph {
    Text(String),
    /// Lines of code, without the fences.
    Code(String),
}

impl Paragraph {
    pub(super) fn text(&self) -> &str {
        let (Paragraph::Text(text) | Paragraph::Code(text)) = self;
        text
    }
}

/// Returns the sections of all pages.
pub(super) fn sections() -> Vec<Section> {
    PAGES.iter().flat_map(|page| read(page)).collect()
}

/// Parses the sections of a page. A section starts at a line `## Title`; text before the first one is skipped.
/// Supports paragraphs, fenced code, lists, links, inline code and emphasis; pictures are skipped.
fn read(page: &str) -> Vec<Section> {
    let mut sections: Vec<Section> = Vec::new();
    let mut lines = page.lines();
    let mut goes_on = false;
    while let Some(line) = lines.next() {
        if let Some(title) = line.strip_prefix("## ") {
            sections.push(Section { title: plain(title), paragraphs: Vec::new() });
            goes_on = false;
            continue;
        }
        let Some(section) = sections.last_mut() else { continue };
        let list = &mut section.paragraphs;
        if line.starts_with("```") {
            let code: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            list.push(Paragraph::Code(code.join("\n")));
            goes_on = false;
        } else if line.is_empty() || line.starts_with("![") {
            goes_on = false;
        } else {
            let (item, text) = match line.strip_prefix("- ") {
                Some(item) => (true, format!("\u{2022} {}", plain(item))),
                None => (false, plain(line.trim_start())),
            };
            match list.last_mut() {
                Some(Paragraph::Text(last)) if goes_on && !item => *last += &format!(" {text}"),
                _ => list.push(Paragraph::Text(text)),
            }
            goes_on = true;
        }
    }
    sections
}

/// Returns a line without markup: for a link, its text.
fn plain(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, link)) = rest.split_once('[') {
        text += before;
        match link.split_once("](").and_then(|(name, after)| Some((name, after.split_once(')')?.1))) {
            Some((name, after)) if !name.contains(']') => {
                text += name;
                rest = after;
            }
            _ => {
                text.push('[');
                rest = link;
            }
        }
    }
    (text + rest).replace("**", "").replace('`', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_parsed_into_sections() {
        let page = "# A page\n\nLeft out.\n\n## First `part`\n\nOne [two](x.md)\nthree, `a[1]`.\n\n![A picture](p.webp)\n\n\
                    ```glsl\nfloat a[2];\n\n// b\n```\n\n- one\n  more\n- **two**\n\n## Second\n\nLast.\n";
        let sections = read(page);
        let titles: Vec<&str> = sections.iter().map(|s| s.title.as_str()).collect();
        assert_eq!(titles, ["First part", "Second"]);
        let text = |text: &str| Paragraph::Text(text.into());
        let first = [
            text("One two three, a[1]."),
            Paragraph::Code("float a[2];\n\n// b".into()),
            text("\u{2022} one more"),
            text("\u{2022} two"),
        ];
        assert_eq!(sections[0].paragraphs, first);
        assert_eq!(sections[1].paragraphs, [text("Last.")]);
    }

    #[test]
    fn help_starts_with_first_steps_and_has_a_bookmarklet_section() {
        let sections = sections();
        assert_eq!(sections[0].title, "First steps");
        assert!(sections.iter().any(|s| s.title == SHADERTOY));
        assert!(sections.iter().all(|s| !s.paragraphs.is_empty()), "a section has no text");
        let odd = sections.iter().flat_map(|s| &s.paragraphs).filter(
            |p| matches!(p, Paragraph::Text(text) if ["](", "**", "|", "###"].iter().any(|mark| text.contains(mark))),
        );
        assert_eq!(odd.map(Paragraph::text).collect::<Vec<_>>(), [""; 0], "Markdown that the help does not know");
    }
}
