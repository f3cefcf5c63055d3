//! `eddy check`: every pass of every project through the compiler, with no graphics device, and what the site would do
//! differently.

use super::{
    args::CheckArgs,
    machine::{Machine, Trouble, millis_since},
    report::{Printer, Report},
};
use crate::{
    diag::{self, Diagnostic},
    engine::{self, CompiledPass},
    glsl::Driver,
    media::{self, MediaSet},
    project::{self, FillKind, Filter, Input, Project, SamplerRules, Wrap},
};
use std::{
    collections::BTreeMap,
    io::{self, Write},
    time::Instant,
};

pub fn run(args: &CheckArgs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    // No device is made; the machine only keeps one project's panic from the others.
    let mut machine = Machine::default();
    for spec in &args.project {
        let mut report = Report::new(spec);
        let mut dumped = String::new();
        machine.attempt(&mut report, |_, report| check(report, spec, args, &mut dumped));
        io::stdout().write_all(dumped.as_bytes())?;
        let errors = report.errors();
        let warnings = report.diagnostics.iter().filter(|m| m.severity == "warning").count();
        let counted = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let words = match (errors, warnings) {
            (0, 0) => "ok".to_owned(),
            (0, n) => format!("ok, {}", counted(n, "warning")),
            (n, 0) => counted(n, "error"),
            (n, m) => format!("{}, {}", counted(n, "error"), counted(m, "warning")),
        };
        printer.print(&report, &format!("{spec}: {words}"))?;
    }
    Ok(printer.exit_code())
}

fn check(report: &mut Report, spec: &str, args: &CheckArgs, dumped: &mut String) -> Result<(), Trouble> {
    let loaded = project::load(spec)?;
    let project = &loaded.project;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(project));
    let began = Instant::now();
    let driver = Driver { without: args.without_pass.set(), ..Driver::default() };
    let (mut found, compiled) = compile(project, driver);
    report.compile_ms = Some(millis_since(began));
    // What a device would be asked.
    found.extend(compiled.iter().filter_map(|pass| pass.validate().err()));
    if let Some(pass) = &args.dump_ir {
        *dumped = dump_ir(project, driver, Some(pass.as_str()).filter(|pass| !pass.is_empty()));
    }
    let mut files = MediaSet::new();
    found.extend(media::files(project, &mut files));
    media::fills(project, &mut files);
    media::meshes(project, &mut files);
    found.extend(files.fill_errors(project));
    found.extend(files.mesh_errors(project));
    found.extend(shared_samplers(project));
    report.diagnose(&found, &project.sources(), Some(project));
    Ok(())
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

/// Returns everything the compiler says of Common alone and of every pass, each once, and what compiled.
fn compile(project: &Project, driver: Driver) -> (Vec<Diagnostic>, Vec<CompiledPass>) {
    let mut found: Vec<Diagnostic> = Vec::new();
    let mut compiled = Vec::new();
    let texts = engine::Sources::new(project);
    found.extend(texts.diagnostics.iter().cloned());
    found.extend(texts.check_common());
    for index in 0..project.passes.len() {
        let pass = texts.compile_pass(index, [false; 4], driver);
        let fills = FillKind::ALL.into_iter().filter_map(|k| texts.compile_fill(index, k, false, driver));
        for outcome in [pass].into_iter().chain(fills) {
            match outcome {
                Ok(mut pass) => {
                    diag::append(&mut found, pass.diagnostics.drain(..));
                    compiled.push(pass);
                }
                Err(errors) => diag::append(&mut found, errors),
            }
        }
    }
    (found, compiled)
}

/// Returns where channels with samplers of their own read a buffer differently from each other, which the site cannot:
/// there a buffer has one wrap, and one filter while a pass draws (`shadertoy.md`, section 7).
fn shared_samplers(project: &Project) -> Vec<Diagnostic> {
    if project.sampler_rules == SamplerRules::Site {
        return Vec::new();
    }
    let mut warnings = Vec::new();
    let mut wraps: BTreeMap<&str, Vec<(String, Wrap)>> = BTreeMap::new();
    for pass in &project.passes {
        let mut filters: BTreeMap<&str, Vec<(String, Filter)>> = BTreeMap::new();
        for (index, channel) in pass.channels.iter().enumerate() {
            let Some(channel) = channel else { continue };
            let Input::Buffer(buffer) = &channel.input else { continue };
            let place = format!("iChannel{index} of {}", pass.id.title());
            filters.entry(buffer).or_default().push((place.clone(), channel.sampler.filter));
            wraps.entry(buffer).or_default().push((place, channel.sampler.wrap));
        }
        warnings
            .extend(filters.iter().filter_map(|(buffer, reads)| differ(buffer, reads, "filter", "while a pass draws")));
    }
    warnings.extend(wraps.iter().filter_map(|(buffer, reads)| differ(buffer, reads, "wrap", "for all passes")));
    warnings
}

fn differ<T: PartialEq + std::fmt::Debug>(
    buffer: &str,
    reads: &[(String, T)],
    what: &str,
    when: &str,
) -> Option<Diagnostic> {
    let (last, wins) = reads.last()?;
    let (other, loses) = reads.iter().find(|(_, setting)| setting != wins)?;
    let name = |setting: &T| format!("{setting:?}").to_lowercase();
    Some(
        Diagnostic::warning(
            None,
            format!(
                "{other} reads Buffer {buffer} with {what} {}, {last} with {}: on the site a buffer has one {what} \
                 {when}, the last one named, and the picture differs",
                name(loses),
                name(wins)
            ),
        )
        .hint(format!(
            "give both the same {what}, or set sampler_rules = \"site\" in eddy.toml to see what the site \
        shows"
        )),
    )
}
