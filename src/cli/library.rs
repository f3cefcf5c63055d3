//! `eddy list`, `eddy import`, `eddy export`: lists presets, converts projects to and from Shadertoy's JSON, and to
//! HTML.

use super::{
    args::{ExportArgs, ExportFormat, ImportArgs, ListArgs},
    command::{CommandError, Run},
    convert,
    machine::{Machine, RunError},
    report::{Printer, Report},
    terminal::{self, one_line, shown_path},
};
use crate::{
    project::{self, Origin, Overwrite, Project, ProjectError},
    session, translate, web,
};
use std::{
    io::{self, Write},
    path::Path,
};

impl Run for ListArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(list()?)
    }
}

fn list() -> io::Result<u8> {
    let mut out = terminal::stdout();
    for name in project::presets::names() {
        writeln!(out, "{name}")?;
    }
    out.flush()?;
    Ok(0)
}

impl Run for ImportArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(import(self)?)
    }
}

fn import(args: &ImportArgs) -> io::Result<u8> {
    let file = args.file.to_string_lossy();
    let to = shown_path(&args.out);
    one(&file, |report| {
        if !args.out.is_dir() && is_file_name(&args.out) {
            return Err(anyhow::anyhow!("--out {to}: give a folder to import into").into());
        }
        let project = read(report, &file)?;
        if !matches!(project.origin, Origin::Json(_)) {
            return Err(anyhow::anyhow!("{file} is not a Shadertoy .json file").into());
        }
        save(&project, &args.out, args.force)?;
        Ok(format!("{}: imported into {to}", one_line(&file)))
    })
}

impl Run for ExportArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(export(self)?)
    }
}

fn export(args: &ExportArgs) -> io::Result<u8> {
    let ends_in = |ending: &str| args.out.extension().is_some_and(|e| e.eq_ignore_ascii_case(ending));
    match args.to {
        Some(ExportFormat::Html) => export_html(args),
        None if ends_in("html") || ends_in("htm") => export_html(args),
        Some(ExportFormat::Isf) => export_isf(args),
        None if ends_in("fs") => export_isf(args),
        Some(ExportFormat::Json) | None => export_json(args),
    }
}

fn export_json(args: &ExportArgs) -> io::Result<u8> {
    let to = shown_path(&args.out);
    one(&args.project, |report| {
        if args.out.extension().is_none_or(|e| !e.eq_ignore_ascii_case("json")) || args.out.is_dir() {
            let endings = if args.to.is_some() { ".json" } else { ".json, .html or .fs" };
            return Err(anyhow::anyhow!("--out {to}: give a file name that ends in {endings}").into());
        }
        let project = read(report, &args.project)?;
        check_directives(&project)?;
        let (project, mut lost) = match project.dialect.has_main() {
            true => convert::shadertoy(report, &project)?,
            false => (project, Vec::new()),
        };
        // An editor may overwrite a JSON project in place; an export must not.
        if !args.force && args.out.symlink_metadata().is_ok() {
            return Err(suggest_force(ProjectError::WouldOverwrite { paths: vec![args.out.clone()] }.into()));
        }
        save(&project, &args.out, args.force)?;
        lost.extend(project::json_losses(&project));
        Ok(format!("{}: exported to {to}{}", one_line(&args.project), convert::listed(&lost)))
    })
}

fn export_html(args: &ExportArgs) -> io::Result<u8> {
    let to = shown_path(&args.out);
    one(&args.project, |report| {
        let is_html = |e: &std::ffi::OsStr| e.eq_ignore_ascii_case("html") || e.eq_ignore_ascii_case("htm");
        if !args.out.extension().is_some_and(is_html) || args.out.is_dir() {
            return Err(anyhow::anyhow!("--out {to}: give a file name that ends in .html").into());
        }
        let project = read(report, &args.project)?;
        let page = match web::export(&project, args.media.as_deref()) {
            Ok(page) => page,
            Err(errors) => return Err(RunError::Diagnostics(errors, project.sources())),
        };
        report.diagnose(&page.diagnostics, &project.sources(), Some(&project));
        let kilobytes = |bytes: usize| bytes.div_ceil(1000);
        let media = match page.media_bytes {
            0 => String::new(),
            bytes => format!(", of which {} kB are media", kilobytes(bytes)),
        };
        let size = kilobytes(page.html.len());
        let overwrite = if args.force { Overwrite::Allow } else { Overwrite::Refuse };
        project::write_named(&args.out, page.html.into_bytes(), overwrite)
            .map_err(RunError::from)
            .map_err(suggest_force)?;
        Ok(format!("{}: exported to {to} ({size} kB{media})", one_line(&args.project)))
    })
}

fn export_isf(args: &ExportArgs) -> io::Result<u8> {
    let to = shown_path(&args.out);
    one(&args.project, |report| {
        if !args.out.extension().is_some_and(|e| e.eq_ignore_ascii_case("fs")) || args.out.is_dir() {
            return Err(anyhow::anyhow!("--out {to}: give a file name that ends in .fs").into());
        }
        let project = read(report, &args.project)?;
        let file = match translate::isf(&project) {
            Ok(file) => file,
            Err(errors) => return Err(RunError::Diagnostics(errors, project.sources())),
        };
        report.diagnose(&file.diagnostics, &project.sources(), Some(&project));
        let overwrite = if args.force { Overwrite::Allow } else { Overwrite::Refuse };
        project::write_named(&args.out, file.text.into_bytes(), overwrite)
            .map_err(RunError::from)
            .map_err(suggest_force)?;
        Ok(format!("{}: exported to {to}", one_line(&args.project)))
    })
}

/// Rejects a project with an invalid directive.
fn check_directives(project: &Project) -> Result<(), RunError> {
    let (found, sources) = session::directive_errors(project);
    if found.is_empty() { Ok(()) } else { Err(RunError::Diagnostics(found, sources)) }
}

/// Processes one project and prints the result.
pub(super) fn one(spec: &str, work: impl FnOnce(&mut Report) -> Result<String, RunError>) -> io::Result<u8> {
    let mut report = Report::new(spec);
    let words = Machine::default().attempt(&mut report, |_, report| work(report));
    let mut printer = Printer::new(false);
    printer.print(&report, &words.unwrap_or_default())?;
    Ok(printer.exit_code())
}

pub(super) fn read(report: &mut Report, spec: &str) -> Result<Project, RunError> {
    let loaded = project::load(spec)?;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(&loaded.project));
    Ok(loaded.project)
}

pub(super) fn save(project: &Project, to: &Path, force: bool) -> Result<(), RunError> {
    let overwrite = if force { Overwrite::Allow } else { Overwrite::Refuse };
    project::save(project, to, overwrite).map(drop).map_err(RunError::from).map_err(suggest_force)
}

/// Adds the option that permits the rejected action.
pub(super) fn suggest_force(trouble: RunError) -> RunError {
    match trouble {
        RunError::Other(error) if matches!(error.downcast_ref(), Some(ProjectError::WouldOverwrite { .. })) => {
            RunError::Other(anyhow::anyhow!("{error} with --force"))
        }
        other => other,
    }
}

pub(super) fn is_file_name(path: &Path) -> bool {
    path.extension().is_some_and(|e| ["json", "glsl", "frag"].iter().any(|known| e.eq_ignore_ascii_case(known)))
}
