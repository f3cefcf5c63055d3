//! The text of a pass for Shadertoy.

mod finish;
mod globals;
mod interface;
mod language;

use super::{
    declarations::declarations,
    renames::{FreeNames, Renames},
    tokens::{Line, Token, tokens},
};
use crate::{CustomUniform, DialectRow, Pass, Project};
use std::{
    collections::{BTreeMap, HashSet},
    ops::Range,
};

/// The facts about a project that the texts of all passes share.
pub(super) struct Context<'p> {
    pub project: &'p Project,
    pub row: &'static DialectRow,
    pub free: FreeNames,
    pub sliders: Vec<CustomUniform>,
    /// The number of the version of GLSL, and whether it is one of GLSL ES.
    pub version: (u32, bool),
    /// The words of Common.
    pub common: HashSet<String>,
}

/// The text of a pass, and what it needs.
pub(super) struct Written {
    pub text: String,
    /// The slots of the pass in the order of `iChannelN`.
    pub slots: Vec<usize>,
    pub reads_pointer: bool,
    /// A macro discards pixels, which keep what they were.
    pub discards_in_macro: bool,
}

/// Returns the text of a pass whose text with all included files is `text`, or the names of its textures if there are
/// too many.
pub(super) fn written(cx: &Context<'_>, pass: &Pass, text: &str) -> Result<Written, Vec<String>> {
    let (tokens, lines) = tokens(text);
    let found = declarations(&tokens, &lines);
    let mut writer = Writer {
        cx,
        pass,
        text,
        tokens,
        lines,
        renames: Renames::default(),
        replaced: BTreeMap::new(),
        deleted: Vec::new(),
        before: String::new(),
        inputs: String::new(),
        outputs: Vec::new(),
        hoisted: HashSet::new(),
        dynamic: HashSet::new(),
        result: Written { text: String::new(), slots: Vec::new(), reads_pointer: false, discards_in_macro: false },
    };
    writer.channels(&found)?;
    writer.interface(&found);
    let colour = writer.colour(&found);
    writer.renames.name("main", cx.free.of("drawPixel"));
    writer.renames.language(&writer.tokens, &found, &cx.free);
    // Shadertoy's are high, and those of `mainImage` must be the same.
    for range in &found.precisions {
        writer.deleted.push(writer.bytes(range));
    }
    writer.lists();
    writer.rows(&found);
    let clear = cx.project.dialect.clear_colour(pass);
    let discards = clear.is_some() && writer.discards(&found);
    writer.directives();
    for at in 0..writer.tokens.len() {
        if let Some(to) = writer.renames.get(&writer.tokens, &found, at) {
            let to = to.to_owned();
            writer.replaced.entry(at).or_insert(to);
        }
    }
    found.empty.iter().for_each(|&at| drop(writer.replaced.insert(at, String::new())));
    let globals = writer.globals(&found);
    writer.finish(&colour, &globals, clear.filter(|_| discards));
    Ok(writer.result)
}

/// Returns Common of a project with its names changed as in the passes.
pub(super) fn common(cx: &Context<'_>, text: &str) -> String {
    let (tokens, lines) = tokens(text);
    let found = declarations(&tokens, &lines);
    let mut renames = Renames::default();
    cx.sliders.iter().for_each(|slider| renames.uniform(&slider.name, &cx.free));
    renames.language(&tokens, &found, &cx.free);
    let mut out = String::with_capacity(text.len());
    let mut done = 0;
    for (at, token) in tokens.iter().enumerate() {
        let Some(to) = renames.get(&tokens, &found, at) else { continue };
        out.push_str(&text[done..token.at]);
        out.push_str(to);
        done = token.end();
    }
    out + &text[done..]
}

struct Writer<'c, 't> {
    cx: &'c Context<'c>,
    pass: &'c Pass,
    text: &'t str,
    tokens: Vec<Token<'t>>,
    lines: Vec<Line<'t>>,
    renames: Renames,
    /// The new texts of tokens.
    replaced: BTreeMap<usize, String>,
    /// Ranges of the text that are left out.
    deleted: Vec<Range<usize>>,
    /// The declarations before the text.
    before: String,
    /// The statements that set what the program sets.
    inputs: String,
    /// The outputs: location, type, name.
    outputs: Vec<(u32, String, String)>,
    /// The names that `before` declares.
    hoisted: HashSet<String>,
    /// Names whose value is not constant.
    dynamic: HashSet<String>,
    result: Written,
}

impl Writer<'_, '_> {
    /// Returns the part of the text from the first to the last of these tokens.
    fn bytes(&self, tokens: &Range<usize>) -> Range<usize> {
        self.tokens[tokens.start].at..self.tokens[tokens.end - 1].end()
    }

    /// Returns a line with its tokens replaced.
    fn line(&self, index: usize) -> String {
        let line = &self.lines[index];
        self.rendered(line.at..line.at + line.text.len())
    }

    /// Returns a part of the text with its tokens replaced.
    fn rendered(&self, range: Range<usize>) -> String {
        let first = self.tokens.partition_point(|token| token.at < range.start);
        let mut out = String::new();
        let mut done = range.start;
        for (at, to) in self.replaced.range(first..) {
            let token = &self.tokens[*at];
            if token.at >= range.end {
                break;
            }
            out.push_str(&self.text[done..token.at]);
            out.push_str(to);
            done = token.end();
        }
        out + &self.text[done..range.end]
    }
}
