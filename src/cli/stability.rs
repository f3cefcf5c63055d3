//! `eddy lab stability`: simulations under hard conditions, and the ones that leave their bounds.

use super::{
    args::StabilityArgs,
    failure::trouble,
    machine::shard_and_device,
    terminal::{self, shown_path},
};
use crate::lab::{
    Extent, LabError, Results, Shard,
    stability::{
        self, CheckedProject, presets,
        run::{self, Options, Step},
    },
};
use std::{
    io::{self, IsTerminal, Write},
    path::Path,
};

/// Exit code 1: a value left a bound that it should have kept, or a case could not be drawn.
const LEFT: u8 = 1;

pub(super) fn run(args: &StabilityArgs) -> io::Result<u8> {
    let names: Vec<String> = match args.project.as_slice() {
        [] => presets::NAMES.map(str::to_owned).into(),
        some => some.to_vec(),
    };
    let subjects: Result<Vec<CheckedProject>, LabError> =
        names.iter().map(|name| CheckedProject::load(name, &args.bound)).collect();
    let subjects = match subjects {
        Ok(subjects) => subjects,
        Err(error) => return Ok(trouble(error)),
    };
    if let Some(bound) = args.bound.iter().find(|b| subjects.iter().all(|s| s.project.pass(&b.quantity.pass).is_none()))
    {
        return Ok(trouble(format_args!("--bound: no project of this call has a pass {}", bound.quantity.pass.key())));
    }
    let (shard, gpu) = match shard_and_device(&args.shard) {
        Ok(both) => both,
        Err(why) => return Ok(trouble(why)),
    };
    let extent = if args.quick { Extent::Quick } else { Extent::Full };
    let options = Options { out: args.out.clone(), extent, size: args.size, shard, only: args.only.clone() };
    let results = match run::run(&gpu, &subjects, &options, tell) {
        Ok(results) => results,
        Err(error) => return Ok(trouble(error)),
    };
    if io::stderr().is_terminal() {
        writeln!(terminal::stderr())?;
    }
    let of_these: Vec<_> = results.cases.iter().filter(|c| names.contains(&c.project)).cloned().collect();
    if of_these.is_empty() && options.shard == Shard::WHOLE {
        return Ok(trouble("no case has this text in its name or kind"));
    }
    let mut out = terminal::stdout();
    write!(out, "{}", stability::table(&of_these))?;
    write!(out, "\n{}", run::coverage(&subjects, &options, &results))?;
    if let Some(folder) = &args.out {
        match files(folder, &results, &subjects) {
            Ok(_) => writeln!(out, "\n{}", shown_path(&folder.join("stability.html")))?,
            Err(error) => return Ok(trouble(error)),
        }
    }
    out.flush()?;
    Ok(if of_these.iter().all(|c| c.is_right()) { 0 } else { LEFT })
}

/// Writes the report of the stability results.
pub(super) fn files(out: &Path, results: &Results, subjects: &[CheckedProject]) -> Result<Vec<String>, LabError> {
    stability::write_of(out, results, subjects)
}

/// Reports on standard error what is drawn: on a terminal in one line that is overwritten, else one line per case.
fn tell(step: Step<'_>) {
    let words = format!("{}/{} {}: {}", step.done + 1, step.all, step.project, step.case.name);
    terminal::replace_line(&words);
}
