//! The GLSL of passes for the browser's compiler: the author's text, in which included files replace their lines and
//! `#line` directives identify the text of each line.

use eddy_diag::SourceId;
use eddy_engine::Sources;
use eddy_project::{FillKind, FillValue, Project};
use std::fmt::Write;

/// The texts so far. Equal texts of the same name are stored once.
pub(crate) struct Texts<'a> {
    project: &'a Project,
    sources: &'a Sources<'a>,
    map: eddy_diag::SourceMap,
    /// By source string number. 0 is the text before the author's.
    pub names: Vec<String>,
    /// The text of each number.
    known: Vec<String>,
    /// GLSL for the player, Common first.
    pub codes: Vec<String>,
}

impl<'a> Texts<'a> {
    pub(crate) fn new(project: &'a Project, sources: &'a Sources<'a>) -> Self {
        let map = project.texts();
        let (names, known) = (vec!["player".into()], vec![String::new()]);
        let mut texts = Self { project, sources, map, names, known, codes: Vec::new() };
        let common = if project.common.is_some() { texts.glsl(Project::COMMON_ID) } else { String::new() };
        texts.codes.push(common);
        texts
    }

    /// Returns the index of a text of the project in [`Texts::codes`].
    pub(crate) fn code(&mut self, id: SourceId) -> usize {
        let code = self.glsl(id);
        let at = self.codes.iter().skip(1).position(|known| *known == code);
        at.map_or_else(
            || {
                self.codes.push(code);
                self.codes.len() - 1
            },
            |at| at + 1,
        )
    }

    /// Returns the program of a fill with an expression, or with a picture that channel 0 reads.
    pub(crate) fn fill(&mut self, pass: usize, kind: FillKind, value: &FillValue) -> String {
        let Some(text) = self.project.fill_text(pass, kind).filter(|_| matches!(value, FillValue::Expression(_)))
        else {
            return "void mainImage(out vec4 o,in vec2 p){bool s=textureSize(iChannel0,0)==ivec2(iResolution.xy);\
                    o=s?texelFetch(iChannel0,ivec2(p),0):texture(iChannel0,p/iResolution.xy);}\n"
                .into();
        };
        let name = self.project.sources().get(text.id).map_or_else(String::new, |source| source.name.clone());
        let number = self.number(&name, &text.text);
        let line = text.text[..text.range.start].matches('\n').count() + 1;
        let expression = &text.text[text.range];
        format!(
            "void mainImage(out vec4 eddy_value,in vec2 fragCoord){{eddy_value=(\n#line {line} {number}\n{expression}\n);}}\n"
        )
    }

    /// Returns the source string number of a text.
    fn number(&mut self, name: &str, text: &str) -> usize {
        let at = (1..self.names.len()).find(|&n| self.names[n] == name && self.known[n] == text);
        at.unwrap_or_else(|| {
            self.names.push(name.to_owned());
            self.known.push(text.to_owned());
            self.names.len() - 1
        })
    }

    fn glsl(&mut self, id: SourceId) -> String {
        let mut out = String::new();
        self.write(id, &mut out);
        out
    }

    fn write(&mut self, id: SourceId, out: &mut String) {
        let sources = self.sources;
        let text = sources.compiler_text(id);
        let name = self.map.get(id).map_or_else(String::new, |source| source.name.clone());
        let number = self.number(&name, text);
        let _ = writeln!(out, "#line 1 {number}");
        let mut own: Vec<_> = sources.include_lines().lines.iter().filter(|(line, _)| line.source == id).collect();
        own.sort_by_key(|(line, _)| line.start);
        let mut done = 0;
        for (line, included) in own {
            let range = line.range();
            out.push_str(&text[done..range.start]);
            if !out.ends_with('\n') {
                out.push('\n');
            }
            self.write(*included, out);
            let next = text[..range.end].matches('\n').count() + 2;
            let _ = write!(out, "#line {next} {number}");
            done = range.end;
        }
        out.push_str(&text[done..]);
        if !out.ends_with('\n') {
            out.push('\n');
        }
    }
}
