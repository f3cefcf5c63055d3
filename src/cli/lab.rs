//! `eddy lab`: runs and reports studies, or merges the results of several machines.

use super::{
    args::{HostProgram, LabArgs, LabCommand},
    command::{CommandError, Run},
    failure::trouble,
    machine::shard_and_device,
    precision, stability,
    terminal::{self, shown_path},
};
use crate::lab::{
    Extent, LabError, PresentFingerprints, RESULTS_FILE, Results, Study,
    cost::MIN_REPEATS,
    report,
    run::{self, Options, Step},
    studies,
};
use std::{
    io::{self, IsTerminal, Write},
    path::{Path, PathBuf},
};

impl Run for LabArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        match &mut self.command {
            Some(LabCommand::Precision(args)) => (args.run.guest, args.project.iter_mut().collect()),
            _ => (None, Vec::new()),
        }
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(run(self)?)
    }
}

fn run(args: &LabArgs) -> io::Result<u8> {
    match &args.command {
        Some(LabCommand::Merge { from, out }) => return finish(merge(from, out)),
        Some(LabCommand::Precision(args)) if args.project.is_empty() && args.out.is_none() => {
            return Ok(trouble("give a PROJECT, or --out DIR to run the study of all presets"));
        }
        Some(LabCommand::Precision(args)) if args.project.is_empty() => {
            let (study, out) = (vec!["precision".to_owned()], args.out.clone());
            let (repeats, shard) = (MIN_REPEATS, "0/1".to_owned());
            return run(&LabArgs { command: None, study, out, list: false, quick: args.quick, repeats, shard });
        }
        Some(LabCommand::Precision(args)) => {
            return match args.run.inputs_of(args.frames()) {
                Ok(inputs) => precision::run(args, &inputs),
                Err(usage) => Ok(trouble(usage)),
            };
        }
        Some(LabCommand::Stability(args)) => return stability::run(args),
        None => {}
    }
    let studies = match studies::named(&args.study) {
        Ok(studies) => studies,
        Err(error) => return Ok(trouble(error)),
    };
    if args.list {
        return list(&studies);
    }
    // clap requires it.
    let Some(out) = &args.out else { return Ok(trouble("--out is missing")) };
    let (shard, gpu) = match shard_and_device(&args.shard) {
        Ok(both) => both,
        Err(why) => return Ok(trouble(why)),
    };
    let extent = if args.quick { Extent::Quick } else { Extent::Full };
    let options = Options { out: out.clone(), extent, repeats: args.repeats, shard };
    let measured = run::run(&gpu, &studies, &options, Progress::default().teller());
    finish(measured.and_then(|results| report(out, &studies, &results)))
}

/// Merges the results of `from` into those of an earlier merge in `out`. Of two results for the same measurement,
/// the one for this build's texts is kept, else the one of `from`.
fn merge(from: &[PathBuf], out: &Path) -> Result<String, LabError> {
    let before = out.join(RESULTS_FILE).exists().then(|| out.to_owned());
    let folders: Vec<PathBuf> = before.into_iter().chain(from.iter().cloned()).collect();
    let mut present = PresentFingerprints::default();
    let results = Results::merge(&folders, |record| present.has(record))?;
    results.write(out)?;
    report(out, &studies::all(), &results)
}

fn report(out: &Path, studies: &[&'static Study], results: &Results) -> Result<String, LabError> {
    // Results that other studies have left there are reported too.
    let all = studies::all();
    let known = all.iter().filter(|s| {
        studies.iter().any(|other| other.name == s.name) || results.errors.iter().any(|e| e.point.study == s.name)
    });
    let mut files = report::write(out, &known.copied().collect::<Vec<_>>(), results)?;
    files.extend(stability::files(out, results, &[])?);
    let failed: Vec<String> = results
        .errors
        .iter()
        .filter_map(|e| Some(format!("\n{} {}: {}", e.point.study, e.point.method, e.trouble.as_ref()?)))
        .collect();
    Ok(format!("{}: {} files{}", shown_path(&out.join("index.html")), files.len(), failed.concat()))
}

fn finish(done: Result<String, LabError>) -> io::Result<u8> {
    match done {
        Ok(words) => {
            writeln!(terminal::stdout(), "{words}")?;
            Ok(0)
        }
        Err(error) => Ok(trouble(error)),
    }
}

fn list(studies: &[&Study]) -> io::Result<u8> {
    let mut out = terminal::stdout();
    for study in studies {
        writeln!(out, "{}: {}", study.name, study.title)?;
        for method in study.methods {
            let settings: Vec<String> = method.settings.iter().map(f64::to_string).collect();
            writeln!(out, "    {:24} {} ({}: {})", method.name, method.title, study.parameter, settings.join(", "))?;
        }
    }
    out.flush()?;
    Ok(0)
}

/// Reports on standard error what is measured: on a terminal in one line that is overwritten, else one line per point.
struct Progress {
    is_terminal: bool,
}

impl Default for Progress {
    fn default() -> Self {
        Self { is_terminal: io::stderr().is_terminal() }
    }
}

impl Progress {
    fn teller(self) -> impl FnMut(Step<'_>) {
        const WIDTH: usize = 24;
        move |step| {
            let words = match step {
                Step::Error { point, done, all } => {
                    let full = WIDTH * done / all.max(1);
                    let bar = format!("{}{}", "#".repeat(full), ".".repeat(WIDTH - full));
                    format!(
                        "[{bar}] {}/{all} {}: {} at {} on {}",
                        done + 1,
                        point.study,
                        point.method,
                        point.setting,
                        point.grid
                    )
                }
                Step::Cost { study, points } => format!("[{}] {study}: timing {points} points", "#".repeat(WIDTH)),
                Step::Resumed(_) | Step::Measured(_) | Step::Estimate { .. } | Step::Turn { .. } | Step::Costed(_) => {
                    return;
                }
            };
            terminal::replace_line(&words);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if self.is_terminal {
            let _ = writeln!(terminal::stderr());
        }
    }
}
