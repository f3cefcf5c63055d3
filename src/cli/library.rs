//! `eddy list`, `eddy import`, `eddy export`: presets by name, and projects to and from the site's JSON.

use super::{
    args::{ExportArgs, ImportArgs},
    machine::{Machine, Trouble},
    report::{Printer, Report},
};
use crate::{
    diag::{self, Diagnostic, SourceMap},
    engine,
    glsl::Driver,
    project::{self, Origin, Overwrite, Project, ProjectError},
};
use std::{
    io::{self, Write},
    path::Path,
};

pub fn list() -> io::Result<u8> {
    let mut out = io::stdout().lock();
    for name in project::presets::names() {
        writeln!(out, "{name}")?;
    }
    out.flush()?;
    Ok(0)
}

pub fn import(args: &ImportArgs) -> io::Result<u8> {
    let file = args.file.to_string_lossy();
    let to = args.out.display();
    one(&file, |report| {
        if !args.out.is_dir() && is_file_name(&args.out) {
            return Err(anyhow::anyhow!("--out {to}: give a folder to import into").into());
        }
        let project = read(report, &file)?;
        if !matches!(project.origin, Origin::Json(_)) {
            return Err(anyhow::anyhow!("{file} is not a Shadertoy .json file").into());
        }
        save(&project, &args.out, args.force)?;
        Ok(format!("{file}: imported into {to}"))
    })
}

pub fn export(args: &ExportArgs) -> io::Result<u8> {
    let to = args.out.display();
    one(&args.project, |report| {
        if args.out.extension().is_none_or(|e| !e.eq_ignore_ascii_case("json")) || args.out.is_dir() {
            return Err(anyhow::anyhow!("--out {to}: give a file name that ends in .json").into());
        }
        let project = read(report, &args.project)?;
        check_directives(&project)?;
        // A JSON file may be saved over itself in an editor; nobody who exports it means that.
        if !args.force && args.out.symlink_metadata().is_ok() {
            return Err(mend(ProjectError::WouldOverwrite { paths: vec![args.out.clone()] }.into()));
        }
        save(&project, &args.out, args.force)?;
        let custom_uniforms: Vec<String> = project.custom_uniforms().list.into_iter().map(|k| k.name).collect();
        let note = match custom_uniforms.len() {
            0 => String::new(),
            1 => format!("; {} becomes a constant", custom_uniforms[0]),
            _ => format!("; {} become constants", project::listed(&custom_uniforms)),
        };
        let has_settings =
            !project.groups.is_empty() || project.passes.iter().any(|p| p.settings != Default::default());
        let lost = if has_settings {
            "; Shadertoy has no sizes, formats, regions, initial states, boundaries or groups of passes, so they \
             are left out"
        } else {
            ""
        };
        Ok(format!("{}: exported to {to}{note}{lost}", args.project))
    })
}

/// Refuses a project with a directive that cannot be obeyed: what it asks for would be missing in the export. Other
/// mistakes of its texts are exported as they are.
fn check_directives(project: &Project) -> Result<(), Trouble> {
    let texts = engine::Sources::new(project);
    let sources = project.sources();
    let mut found = texts.diagnostics.clone();
    for outcome in texts.compile_all(Driver::default()) {
        let said = outcome.map_or_else(|errors| errors, |_| Vec::new());
        diag::append(&mut found, said.into_iter().filter(|d| is_of_directive(d, &sources)));
    }
    found.retain(Diagnostic::is_error);
    if found.is_empty() { Ok(()) } else { Err(Trouble::Diagnostics(found, sources)) }
}

/// Returns whether a message is about a directive that GLSL itself does not have.
fn is_of_directive(diagnostic: &Diagnostic, sources: &SourceMap) -> bool {
    const GLSL: [&str; 12] =
        ["define", "undef", "if", "ifdef", "ifndef", "elif", "else", "endif", "error", "line", "version", "extension"];
    let line = diagnostic.span.and_then(|span| {
        let text = &sources.get(span.source)?.text;
        let begin = text.get(..span.start as usize)?.rfind('\n').map_or(0, |i| i + 1);
        text[begin..].lines().next().map(str::trim_start)
    });
    let word = line.and_then(|line| line.strip_prefix('#')).map(str::trim_start);
    word.is_some_and(|rest| !GLSL.contains(&rest.split(|c: char| !c.is_alphanumeric()).next().unwrap_or_default()))
}

/// Does the work of one project and prints what became of it.
fn one(spec: &str, work: impl FnOnce(&mut Report) -> Result<String, Trouble>) -> io::Result<u8> {
    let mut report = Report::new(spec);
    let words = Machine::default().attempt(&mut report, |_, report| work(report));
    let mut printer = Printer::new(false);
    printer.print(&report, &words.unwrap_or_default())?;
    Ok(printer.exit_code())
}

fn read(report: &mut Report, spec: &str) -> Result<Project, Trouble> {
    let loaded = project::load(spec)?;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(&loaded.project));
    Ok(loaded.project)
}

fn save(project: &Project, to: &Path, force: bool) -> Result<(), Trouble> {
    let overwrite = if force { Overwrite::Allow } else { Overwrite::Refuse };
    project::save(project, to, overwrite).map(drop).map_err(Trouble::from).map_err(mend)
}

/// Names the option that allows what was refused.
fn mend(trouble: Trouble) -> Trouble {
    match trouble {
        Trouble::Other(error) if matches!(error.downcast_ref(), Some(ProjectError::WouldOverwrite { .. })) => {
            Trouble::Other(anyhow::anyhow!("{error} with --force"))
        }
        other => other,
    }
}

fn is_file_name(path: &Path) -> bool {
    path.extension().is_some_and(|e| ["json", "glsl", "frag"].iter().any(|known| e.eq_ignore_ascii_case(known)))
}
