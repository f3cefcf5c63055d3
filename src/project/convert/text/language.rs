//! Parts of other versions of GLSL that GLSL ES 3.00 lacks.

use super::{
    super::{
        declarations::Declarations,
        tokens::{Line, is_letter},
        values,
        words::ONE_DIMENSIONAL,
    },
    Writer,
};
use std::{collections::HashSet, fmt::Write};

impl<'t> Writer<'_, 't> {
    /// Replaces lists in braces, `float a[2] = { 1.0, 2.0 }`, by constructors.
    pub(super) fn lists(&mut self) {
        let tokens = &self.tokens;
        for at in 1..tokens.len() {
            if !tokens[at].is("{") || !tokens[at - 1].is("=") {
                continue;
            }
            // The type is before the name; either may have brackets after it.
            let mut place = at - 1;
            let mut is_array = false;
            let mut words = Vec::new();
            while words.len() < 2 && place > 0 {
                place -= 1;
                if tokens[place].is("]") {
                    is_array = true;
                    while place > 0 && !tokens[place].is("[") {
                        place -= 1;
                    }
                } else {
                    words.push(tokens[place].text);
                }
            }
            let Some(ty) = words.get(1).filter(|ty| ty.starts_with(is_letter)) else { continue };
            let mut depth = 0;
            for (place, token) in tokens.iter().enumerate().skip(at) {
                if token.is("{") {
                    let outer = if depth == 0 && is_array { format!("{ty}[](") } else { format!("{ty}(") };
                    self.replaced.insert(place, outer);
                    depth += 1;
                } else if token.is("}") {
                    self.replaced.insert(place, ")".to_owned());
                    depth -= 1;
                    if depth == 0 {
                        break;
                    }
                }
            }
        }
    }

    /// Replaces one-dimensional textures, which GLSL ES lacks, by rows of two-dimensional ones.
    pub(super) fn rows(&mut self, found: &Declarations<'t>) {
        let declared = found.interface.iter().filter(|variable| variable.ty == "sampler1D");
        let mut names: HashSet<&str> = declared.map(|variable| variable.name).collect();
        let parameters = self.tokens.windows(2).filter(|pair| pair[0].is("sampler1D"));
        names.extend(parameters.map(|pair| pair[1].text));
        let mut needed: Vec<&str> = Vec::new();
        for at in 0..self.tokens.len() {
            let token = self.tokens[at];
            if token.is("sampler1D") {
                self.replaced.insert(at, "sampler2D".to_owned());
            }
            let is_read =
                |name: &str| name == "texture1D" || self.tokens.get(at + 2).is_some_and(|row| names.contains(row.text));
            let is_call = self.tokens.get(at + 1).is_some_and(|next| next.is("("));
            let row = ONE_DIMENSIONAL.iter().find(|(old, ..)| token.is(old) && is_call && is_read(old));
            if let Some((_, function, _)) = row {
                needed.push(function);
                self.replaced.insert(at, self.cx.free.of(function));
            }
        }
        for (_, function, text) in ONE_DIMENSIONAL {
            if needed.contains(&function) {
                self.before.push_str(&text.replace(function, &self.cx.free.of(function)));
            }
        }
    }

    /// Replaces `discard`: on Shadertoy the pixel keeps what it was, and here it has the colour with which the target
    /// is cleared. Returns whether there is any.
    pub(super) fn discards(&mut self, found: &Declarations<'t>) -> bool {
        let flag = self.cx.free.of("isDiscarded");
        let mut any = false;
        for at in 0..self.tokens.len() {
            if !self.tokens[at].is("discard") {
                continue;
            }
            let function = found.functions.iter().find(|function| function.body.contains(&at));
            let (Some(function), None) = (function, self.tokens[at].line) else {
                self.result.discards_in_macro = true;
                continue;
            };
            let value = match function.result.as_str() {
                "void" => "return;".to_owned(),
                ty if values::is_basic(ty) => format!("return {};", values::zero(ty)),
                ty => format!("{ty} none; return none;"),
            };
            self.replaced.insert(at, format!("{{ {flag} = true; {value} }}"));
            if self.tokens.get(at + 1).is_some_and(|next| next.is(";")) {
                self.replaced.insert(at + 1, String::new());
            }
            any = true;
        }
        if any {
            let _ = writeln!(self.before, "bool {flag} = false;");
        }
        any
    }

    /// Replaces the macros of the version, and comments out lines that only the program understands.
    pub(super) fn directives(&mut self) {
        let (number, is_es) = self.cx.version;
        for at in 0..self.tokens.len() {
            let to = match self.tokens[at].text {
                "__VERSION__" => number.to_string(),
                "GL_ES" | "GL_FRAGMENT_PRECISION_HIGH" if !is_es => self.cx.free.of("isNotES"),
                "GL_OES_standard_derivatives" if number == 100 => "GL_ES".to_owned(),
                _ => continue,
            };
            self.replaced.insert(at, to);
        }
        let is_other = |line: &Line<'_>| matches!(line.name, "version" | "extension");
        let starts: HashSet<usize> = (0..self.lines.len()).filter(|&line| is_other(&self.lines[line])).collect();
        for at in 0..self.tokens.len() {
            let Some(line) = self.tokens[at].line.filter(|line| starts.contains(line)) else { continue };
            if self.tokens[at].is("#") && (at == 0 || self.tokens[at - 1].line != Some(line)) {
                self.replaced.insert(at, "// #".to_owned());
            }
        }
    }
}
