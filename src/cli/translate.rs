//! `eddy translate`: writes the passes of a project in another shading language, into a folder.

use super::{
    args::TranslateArgs,
    command::{CommandError, Run},
    library::suggest_force,
    machine::{Machine, RunError},
    report::{Printer, Report},
    terminal::{one_line, shown_path},
    written::write_all,
};
use crate::{
    project,
    translate::{self, Language},
};
use serde::Serialize;
use std::{io, path::PathBuf};

/// A line of `--json`.
#[derive(Serialize)]
struct JsonLine<'a> {
    #[serde(flatten)]
    report: &'a Report,
    language: &'static str,
    language_version: Option<&'static str>,
    /// The folder of the files.
    out: String,
    /// The names of the written files; none if the project has errors.
    files: Vec<String>,
}

impl Run for TranslateArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        let language = self.language()?;
        Ok(run(self, language)?)
    }
}

fn run(args: &TranslateArgs, language: Language) -> io::Result<u8> {
    let mut report = Report::new(&args.project);
    let folder = args.out.clone().unwrap_or_else(|| default_folder(&args.project, language));
    // No device is created; the machine only turns a panic into an error.
    let written = Machine::default().attempt(&mut report, |_, report| {
        let loaded = project::load(&args.project)?;
        let project = &loaded.project;
        report.diagnose(&loaded.warnings, &loaded.sources, Some(project));
        let done = match translate::translate(project, language) {
            Ok(done) => done,
            Err(errors) => {
                report.diagnose(&errors, &project.sources(), Some(project));
                return Ok(Vec::new());
            }
        };
        report.diagnose(&done.diagnostics, &project.sources(), Some(project));
        let files = done.files.iter().map(|file| (file.name.as_str(), &file.bytes[..]));
        write_all(&folder, files, args.force).map_err(RunError::from).map_err(suggest_force)?;
        Ok(done.files.into_iter().map(|file| file.name).collect())
    });
    let files = written.unwrap_or_default();
    let words = match files.len() {
        0 => String::new(),
        n => format!("{}: {n} files of {language} written to {}", one_line(&args.project), shown_path(&folder)),
    };
    let mut printer = Printer::new(args.json);
    let out = folder.display().to_string();
    let line = JsonLine { report: &report, language: language.key(), language_version: language.version(), out, files };
    printer.print_as(&line, &report, &words)?;
    Ok(printer.exit_code())
}

fn default_folder(spec: &str, language: Language) -> PathBuf {
    PathBuf::from(format!("{}-{}", project::stem(spec), language.key()))
}
