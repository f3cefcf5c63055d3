//! `eddy check`: compiles every pass of every project, without a graphics device, and reports differences from
//! Shadertoy.

use super::{
    args::{CheckArgs, Consumer},
    command::{CommandError, Run},
    machine::{Machine, RunError, millis_since},
    report::{Printer, Report},
    terminal::{self, one_line},
};
use crate::{
    diag::{self, Diagnostic},
    engine::{self, CompiledPass},
    glsl::{Driver, PassKind, PassSource, Text, services::Analysis},
    media,
    project::{self, Dialect, Origin, Project, ShaderForm, ghostty, xscreensaver},
};
use std::{
    io::{self, Write},
    time::Instant,
};

impl Run for CheckArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(run(self)?)
    }
}

fn run(args: &CheckArgs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    // No device is created; the machine only isolates the projects from each other's panics.
    let mut machine = Machine::default();
    for spec in &args.project {
        let mut report = Report::new(spec);
        let mut dumped = String::new();
        machine.attempt(&mut report, |_, report| check(report, spec, args, &mut dumped));
        terminal::stdout().write_all(dumped.as_bytes())?;
        let errors = report.errors();
        let warnings = report.diagnostics.iter().filter(|m| m.severity == "warning").count();
        let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let words = match (errors, warnings) {
            (0, 0) => "ok".to_owned(),
            (0, n) => format!("ok, {}", counted(n, "warning")),
            (n, 0) => counted(n, "error"),
            (n, m) => format!("{}, {}", counted(n, "error"), counted(m, "warning")),
        };
        printer.print(&report, &format!("{}: {words}", one_line(spec)))?;
    }
    Ok(printer.exit_code())
}

fn check(report: &mut Report, spec: &str, args: &CheckArgs, dumped: &mut String) -> Result<(), RunError> {
    let consumed = args.consumer.map(|consumer| consumer.spec(spec));
    let loaded = project::load(consumed.as_deref().unwrap_or(spec))?;
    let project = &loaded.project;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(project));
    let began = Instant::now();
    if let Some(found) = check_plain(project) {
        report.diagnose(&found, &project.sources(), Some(project));
        report.compile_ms = Some(millis_since(began));
        return Ok(());
    }
    let driver = Driver { disabled_optimisations: args.without_pass.set(), ..Driver::default() };
    let (mut found, compiled) = compile(project, driver);
    report.compile_ms = Some(millis_since(began));
    // The validation that a device would perform.
    found.extend(compiled.iter().filter_map(|pass| pass.validate().err()));
    if let Some(pass) = &args.dump_ir {
        *dumped = dump_ir(project, driver, Some(pass.as_str()).filter(|pass| !pass.is_empty()));
    }
    if project.dialect == Dialect::Ghostty {
        found.extend(ghostty::advice(project));
    }
    if args.consumer == Some(Consumer::Xscreensaver) {
        found.extend(xscreensaver::advice(project));
    }
    found.extend(media::diagnose(project));
    // The reader has already reported some of it, with its place in `eddy.toml`.
    let is_new = |d: &Diagnostic| !loaded.warnings.iter().any(|known| d.repeats(known));
    found.extend(project::advice(project).into_iter().filter(is_new));
    report.diagnose(&found, &project.sources(), Some(project));
    Ok(())
}

/// Returns the compiler's diagnostics for a plain shader, like the language server; `None` for other files.
fn check_plain(project: &Project) -> Option<Vec<Diagnostic>> {
    // The texts around a file of another program are generated.
    let is_alone = project.dialect == Dialect::Shadertoy;
    let (true, Origin::File(path), [pass]) = (is_alone, &project.origin, project.passes.as_slice()) else {
        return None;
    };
    let kind = match ShaderForm::of(path, &pass.source.text) {
        ShaderForm::PlainVertex => PassKind::PlainVertex,
        ShaderForm::Program(_) => return None,
    };
    let text = Text { id: Project::pass_id(0), text: &pass.source.text };
    Some(Analysis::new(&PassSource::new(kind, text)).diagnostics().to_vec())
}

/// The intermediate representation of every pass that compiles.
fn dump_ir(project: &Project, driver: Driver, pass: Option<&str>) -> String {
    let texts = engine::Sources::new(project);
    let mut out = String::new();
    for (index, own) in project.passes.iter().enumerate() {
        if let Ok(text) = texts.dump_ir(index, driver, pass) {
            out.push_str(&format!("; {}\n{text}", own.id.title()));
        }
    }
    out
}

/// Returns the compiler's diagnostics of Common alone and of every pass, without duplicates, and the compiled passes.
fn compile(project: &Project, driver: Driver) -> (Vec<Diagnostic>, Vec<CompiledPass>) {
    let mut found: Vec<Diagnostic> = Vec::new();
    let mut compiled = Vec::new();
    let texts = engine::Sources::new(project);
    found.extend(texts.diagnostics.iter().cloned());
    found.extend(texts.check_common());
    for outcome in texts.compile_all(driver) {
        match outcome {
            Ok(mut pass) => {
                diag::append(&mut found, pass.diagnostics.drain(..));
                compiled.push(pass);
            }
            Err(errors) => diag::append(&mut found, errors),
        }
    }
    (found, compiled)
}
