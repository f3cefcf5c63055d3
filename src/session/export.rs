//! Exports the open project as Shadertoy JSON. Features that it cannot express are listed before anything is written,
//! and no file is replaced without asking.

use super::{
    command::Question,
    files::save_over,
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_diag::{self as diag, Diagnostic, SourceMap};
use eddy_engine as engine;
use eddy_glsl::Driver;
use eddy_project::{self as project, Project, ProjectError, convert::ConversionError};
use eddy_translate as translate;
use std::{
    borrow::Cow,
    path::{Path, PathBuf},
};

impl OpenProject {
    /// Writes the project to a JSON file if nothing is lost and the file does not exist; asks first otherwise. The
    /// project's origin and unsaved state stay.
    pub(super) fn export_json(&mut self, file: &Path) {
        self.dismiss_notices(About::Export);
        let file = as_json(&std::path::absolute(file).unwrap_or_else(|_| file.to_owned()));
        self.settle_includes();
        if let Err(why) = exportable(self.project(), &file) {
            self.notice_about(About::Export, Level::Error, format!("not exported: {why}"));
            return;
        }
        let (_, lost) = match self.exported() {
            Ok(exported) => exported,
            Err(why) => return self.notice_about(About::Export, Level::Error, format!("not exported: {why}")),
        };
        let exists = file.symlink_metadata().is_ok();
        if exists || !lost.is_empty() {
            self.ask(Question::Export { file, exists, lost });
        } else {
            self.write_json(&file, false);
        }
    }

    /// `replaces`: the user allows replacing the existing file.
    pub(super) fn write_json(&mut self, file: &Path, replaces: bool) {
        let replaced = if replaces { vec![file.to_owned()] } else { Vec::new() };
        let (project, lost) = match self.exported() {
            Ok(exported) => exported,
            Err(why) => return self.notice_about(About::Export, Level::Error, format!("not exported: {why}")),
        };
        match save_over(&project, file, &replaced, self.host.options.recovery.as_deref()) {
            Ok((_, kept)) => {
                self.notice_with_path(
                    About::Export,
                    Level::Info,
                    format!("exported {}", file.display()),
                    file.to_owned(),
                );
                if let Some(kept) = kept {
                    self.report_kept_files(1, kept);
                }
            }
            // The file was created while the question was open.
            Err(ProjectError::WouldOverwrite { .. }) if !replaces => {
                self.ask(Question::Export { file: file.to_owned(), exists: true, lost });
            }
            Err(e) => self.notice_about(About::Export, Level::Error, format!("not exported: {e}")),
        }
    }
}

impl OpenProject {
    /// Returns the project in Shadertoy's form, with a sentence for each thing that is lost.
    fn exported(&self) -> Result<(Cow<'_, Project>, Vec<String>), ConversionError> {
        let own = self.project();
        if !own.dialect.has_main() {
            return Ok((Cow::Borrowed(own), project::json_losses(own)));
        }
        let made = translate::shadertoy(own)?;
        let mut lost = made.notes;
        lost.extend(made.errors.first().map(|error| format!("The converted code has an error: {}.", error.message)));
        lost.extend(project::json_losses(&made.project));
        Ok((Cow::Owned(made.project), lost))
    }
}

fn exportable(project: &Project, file: &Path) -> Result<(), String> {
    if file.is_dir() {
        return Err(format!("{} is a folder; give the name of a .json file", file.display()));
    }
    let (diagnostics, sources) = directive_errors(project);
    if !diagnostics.is_empty() {
        return Err(format!(
            "a directive of the code has an error\n{}",
            diag::render_all(&diagnostics, &sources).trim_end()
        ));
    }
    Ok(())
}

/// Returns a file name with the JSON extension.
fn as_json(file: &Path) -> PathBuf {
    if file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")) {
        return file.to_owned();
    }
    let mut name = file.file_name().unwrap_or_default().to_owned();
    name.push(".json");
    file.with_file_name(name)
}

/// Returns the errors of directives that cannot be followed: the export would lack what they request. Other errors in a
/// project's texts are exported as they are.
pub fn directive_errors(project: &Project) -> (Vec<Diagnostic>, SourceMap) {
    let texts = engine::Sources::new(project);
    let sources = project.sources();
    let mut found = texts.diagnostics.clone();
    for outcome in texts.compile_all(Driver::default()) {
        let said = outcome.map_or_else(|errors| errors, |_| Vec::new());
        diag::append(&mut found, said.into_iter().filter(|d| is_of_directive(d, &sources)));
    }
    found.retain(Diagnostic::is_error);
    (found, sources)
}

/// Returns whether a message is about a directive that is not part of GLSL.
fn is_of_directive(diagnostic: &Diagnostic, sources: &SourceMap) -> bool {
    const GLSL: [&str; 12] =
        ["define", "undef", "if", "ifdef", "ifndef", "elif", "else", "endif", "error", "line", "version", "extension"];
    let line = diagnostic.span.and_then(|span| {
        let text = &sources.get(span.source)?.text;
        let line_start = text.get(..span.start as usize)?.rfind('\n').map_or(0, |i| i + 1);
        text[line_start..].lines().next().map(str::trim_start)
    });
    let word = line.and_then(|line| line.strip_prefix('#')).map(str::trim_start);
    // Text may precede an `#include`: a comment that ends in its line.
    diagnostic.message.starts_with("#include ")
        || word
            .is_some_and(|rest| !GLSL.contains(&rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_extension_is_added() {
        for (given, wanted) in [("/a/b", "/a/b.json"), ("/a/b.JSON", "/a/b.JSON"), ("/a/v1.2", "/a/v1.2.json")] {
            assert_eq!(as_json(Path::new(given)), Path::new(wanted));
        }
    }
}
