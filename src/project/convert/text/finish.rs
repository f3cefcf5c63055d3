//! Puts the text of a pass together.

use super::Writer;
use crate::{AlphaRule, TexelFormat};
use std::fmt::Write;

impl Writer<'_, '_> {
    /// Puts the text together.
    pub(super) fn finish(&mut self, colour: &str, globals: &str, clear: Option<[f32; 4]>) {
        let (cx, pass) = (self.cx, self.pass);
        let mut own = String::with_capacity(self.text.len());
        self.deleted.sort_by_key(|range| range.start);
        let mut done = 0;
        for range in self.deleted.iter().filter(|range| !range.is_empty()) {
            if range.start < done {
                continue;
            }
            own.push_str(&self.rendered(done..range.start));
            done = range.end;
            // A line that is now empty is removed.
            let is_start = own.rfind('\n').map_or(own.as_str(), |end| &own[end + 1..]).trim().is_empty();
            let rest = &self.text[done..];
            let end = rest.find('\n').map_or(rest.len(), |end| end + 1);
            if is_start && rest[..end].trim().is_empty() {
                own.truncate(own.trim_end_matches([' ', '\t']).len());
                done += end;
            }
        }
        own.push_str(&self.rendered(done..self.text.len()));
        let [set_inputs, set_globals, draw, color, at] =
            ["setInputs", "setGlobals", "drawPixel", "fragColor", "fragCoord"].map(|name| cx.free.of(name));
        let file = match &cx.project.origin {
            crate::Origin::File(path) => path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            _ => cx.project.name.clone(),
        };
        let file = file.replace(['\n', '\r', '\\'], " ");
        let mut out = format!("// {} of {file}, a shader for {}.\n\n", pass.id.title(), cx.row.title);
        out.push_str(&self.before);
        if !self.inputs.is_empty() {
            let _ = writeln!(out, "\nvoid {set_inputs}() {{\n{}}}", self.inputs);
        }
        out.push('\n');
        out.push_str(own.trim_start_matches('\u{feff}').trim_matches(['\n', '\r']));
        out.push('\n');
        if !globals.is_empty() {
            let _ = writeln!(out, "\nvoid {set_globals}() {{\n{globals}}}");
        }
        let mut body = String::new();
        if !self.inputs.is_empty() {
            let _ = writeln!(body, "    {set_inputs}();");
        }
        if !globals.is_empty() {
            let _ = writeln!(body, "    {set_globals}();");
        }
        let _ = writeln!(body, "    {draw}();\n    {color} = {colour};");
        body.push_str(&alpha(cx.project.dialect.alpha(pass), &color, pass.id.is_image()));
        if let Some(clear) = clear {
            let clear: Vec<String> = clear.iter().map(|part| format!("{part:?}")).collect();
            let _ = writeln!(body, "    if ({}) {color} = vec4({});", cx.free.of("isDiscarded"), clear.join(", "));
        }
        if pass.settings.format == TexelFormat::Rgba8 {
            let _ = writeln!(body, "    {color} = clamp({color}, 0.0, 1.0);");
        }
        let _ = write!(out, "\nvoid mainImage(out vec4 {color}, in vec2 {at}) {{\n{body}}}\n");
        self.result.text = out;
    }
}

/// Returns the statements that treat the alpha of a colour as the program does.
fn alpha(rule: AlphaRule, color: &str, is_image: bool) -> String {
    match rule {
        AlphaRule::Stored => String::new(),
        // Image is opaque.
        AlphaRule::Opaque if is_image => String::new(),
        AlphaRule::Opaque => format!("    {color}.a = 1.0;\n"),
        AlphaRule::OverBlack => {
            format!("    {color} = vec4({color}.rgb * clamp({color}.a, 0.0, 1.0), 1.0);\n")
        }
        AlphaRule::OverTransparent => {
            format!("    {color}.a = clamp({color}.a, 0.0, 1.0);\n    {color} *= {color}.a;\n")
        }
    }
}
