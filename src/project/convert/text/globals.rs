//! Initial values of globals, which must be constant in GLSL ES 3.00.

use super::{super::declarations::Declarations, Writer};
use std::{collections::HashMap, fmt::Write};

impl<'t> Writer<'_, 't> {
    /// Takes the initial values of globals that are not constant, which GLSL ES requires, out of the declarations.
    /// Returns the statements that set them.
    pub(super) fn globals(&mut self, found: &Declarations<'t>) -> String {
        self.dynamic.extend(["gl_FragCoord", "gl_FrontFacing", "gl_PointCoord"].map(str::to_owned));
        let functions = found.functions.iter().map(|function| function.name.to_owned());
        self.dynamic.extend(functions);
        let variables = found.globals.iter().filter(|global| global.constant.is_none());
        self.dynamic.extend(variables.map(|global| global.name.to_owned()));
        let macros = self.macros();
        let mut statements = String::new();
        for global in &found.globals {
            let Some(value) = global.value.clone().filter(|value| value.start < value.end) else { continue };
            if !value.clone().any(|at| self.is_dynamic(self.tokens[at].text, &macros, 0)) {
                continue;
            }
            self.dynamic.insert(global.name.to_owned());
            if let Some(constant) = global.constant {
                self.replaced.insert(constant, String::new());
            }
            let (start, end) = (self.tokens[value.start - 1].at, self.tokens[value.end - 1].end());
            let text = self.rendered(start..end);
            // Blanks before `=`.
            let start = self.text[..start].trim_end().len();
            self.deleted.push(start..end);
            for lines in &global.conditions {
                lines.iter().for_each(|&line| statements.push_str(&format!("{}\n", self.line(line))));
            }
            let name = self.renames.new_name(global.name);
            let _ = writeln!(statements, "    {name} {text};");
            global.conditions.iter().for_each(|_| statements.push_str("#endif\n"));
        }
        statements
    }

    /// The words in the definition of each macro.
    pub(super) fn macros(&self) -> HashMap<&'t str, Vec<&'t str>> {
        let mut found: HashMap<&str, Vec<&str>> = HashMap::new();
        for (index, _) in self.lines.iter().enumerate().filter(|(_, line)| line.name == "define") {
            let words: Vec<&str> = self
                .tokens
                .iter()
                .filter(|token| token.line == Some(index) && token.is_word())
                .map(|token| token.text)
                .collect();
            if let [_, name, body @ ..] = words.as_slice() {
                found.entry(name).or_default().extend(body);
            }
        }
        found
    }

    pub(super) fn is_dynamic(&self, word: &str, macros: &HashMap<&'t str, Vec<&'t str>>, depth: usize) -> bool {
        const DEEPEST: usize = 16;
        let of_macro = || {
            macros.get(word).is_some_and(|body| {
                depth < DEEPEST && body.iter().any(|inner| *inner != word && self.is_dynamic(inner, macros, depth + 1))
            })
        };
        self.dynamic.contains(word) || of_macro()
    }
}
