//! Exports the open project as an HTML file that plays it. Features that the page cannot show are listed before
//! anything is written, and no file is replaced without asking.

use super::{
    command::Question,
    open_project::OpenProject,
    recovery::place_for_replaced,
    view::{About, Level},
};
use eddy_diag::{self as diag, Diagnostic, Severity};
use eddy_project::{self as project, Overwrite, ProjectError};
use eddy_web as web;
use std::path::{Path, PathBuf};

impl OpenProject {
    /// Writes the project to an HTML file if the page shows everything and the file does not exist; asks first
    /// otherwise. The project's origin and unsaved state stay.
    pub(super) fn export_page(&mut self, file: &Path) {
        self.dismiss_notices(About::Export);
        let file = as_html(&std::path::absolute(file).unwrap_or_else(|_| file.to_owned()));
        self.settle_includes();
        if file.is_dir() {
            let text = format!("not exported: {} is a folder; give the name of a .html file", file.display());
            self.notice_about(About::Export, Level::Error, text);
            return;
        }
        let Some((_, lost)) = self.page() else { return };
        let exists = file.symlink_metadata().is_ok();
        if exists || !lost.is_empty() {
            self.ask(Question::Export { file, exists, lost });
        } else {
            self.write_page(&file, false);
        }
    }

    /// `replaces`: the user allows replacing the existing file.
    pub(super) fn write_page(&mut self, file: &Path, replaces: bool) {
        let Some((html, lost)) = self.page() else { return };
        let kept = replaces.then(|| place_for_replaced(self.host.options.recovery.as_deref(), file));
        let overwrite = kept.as_deref().map_or(Overwrite::Refuse, Overwrite::KeepIn);
        match project::write_named(file, html.into_bytes(), overwrite) {
            Ok(()) => {
                let text = format!("exported {}", file.display());
                self.notice_with_path(About::Export, Level::Info, text, file.to_owned());
                if let Some(kept) = kept.filter(|kept| kept.exists()) {
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

    /// Returns the page of the project and the features that it does not show, each as a sentence. `None`: the project
    /// has errors, which are reported.
    fn page(&mut self) -> Option<(String, Vec<String>)> {
        match web::export(self.project(), self.host.options.media_dir.as_deref()) {
            Ok(page) => {
                // The compiler's warnings have a place, and are in the list of problems already.
                let is_new = |d: &&Diagnostic| d.severity == Severity::Warning && d.span.is_none();
                let lost = page.diagnostics.iter().filter(is_new).map(|d| d.message.clone()).collect();
                Some((page.html, lost))
            }
            Err(errors) => {
                let errors: Vec<Diagnostic> = errors.into_iter().filter(Diagnostic::is_error).collect();
                let rendered = diag::render_all(&errors, &self.project().sources());
                self.notice_about(About::Export, Level::Error, format!("not exported: {}", rendered.trim_end()));
                None
            }
        }
    }
}

/// Returns whether a file has the extension of a page.
pub(super) fn is_page(file: &Path) -> bool {
    file.extension().is_some_and(|e| e.eq_ignore_ascii_case("html") || e.eq_ignore_ascii_case("htm"))
}

/// Returns a file name with the HTML extension.
fn as_html(file: &Path) -> PathBuf {
    if is_page(file) {
        return file.to_owned();
    }
    let mut name = file.file_name().unwrap_or_default().to_owned();
    name.push(".html");
    file.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_extension_is_added() {
        for (given, wanted) in [("/a/b", "/a/b.html"), ("/a/b.HTM", "/a/b.HTM"), ("/a/v1.2", "/a/v1.2.html")] {
            assert_eq!(as_html(Path::new(given)), Path::new(wanted));
        }
    }
}
