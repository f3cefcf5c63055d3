//! `eddy tune`: finds a cheaper setting of a project's quality constants within a bound of error.

mod apply;
mod output;

use super::{
    args::{HostProgram, TuneArgs},
    command::{CommandError, Run},
    machine::{Machine, RunError},
    report::{Printer, Report, Status},
    terminal,
};
use crate::{
    media,
    playback::prices,
    project::{self, Project},
    tune::{self, Found, Kind, Knob, Progress, Request, Scene, Tuning, default_frames},
};
use anyhow::{Context, anyhow};
use output::{JsonKnob, JsonLine};
use serde::Deserialize;
use std::{
    collections::BTreeMap,
    fs,
    io::{self, IsTerminal, Write},
};

/// Knobs that are tried unless some are named: each needs measurements of its own.
const MOST_KNOBS: usize = 6;
/// Knobs of which those are chosen, by what they can save.
const MOST_FOUND: usize = 16;

impl Run for TuneArgs {
    const OPENS_DEVICE: bool = true;

    fn hosted(&mut self) -> (Option<HostProgram>, Vec<&mut String>) {
        (self.run.guest, vec![&mut self.project])
    }

    fn run(&mut self) -> Result<u8, CommandError> {
        self.run.inputs()?;
        Ok(run(self)?)
    }
}

fn run(args: &TuneArgs) -> io::Result<u8> {
    let mut printer = Printer::new(args.json);
    let mut machine = Machine::of(&args.run);
    let mut report = Report::new(&args.project);
    let done = machine.attempt(&mut report, |machine, report| tuned(machine, report, args));
    let words = done.as_ref().map_or(String::new(), |done| done.words.clone());
    let line = JsonLine { report: &report, result: done.as_ref().map(|done| &done.json) };
    printer.print_as(&line, &report, words.trim_end())?;
    Ok(printer.exit_code())
}

/// The output of a call.
struct Done {
    words: String,
    json: serde_json::Value,
}

fn tuned(machine: &mut Machine, report: &mut Report, args: &TuneArgs) -> Result<Done, RunError> {
    let loaded = project::load(&args.project)?;
    let mut project = loaded.project;
    report.diagnose(&loaded.warnings, &loaded.sources, Some(&project));
    for assignment in &args.run.set {
        project.set_custom_uniform(assignment).map_err(|why| anyhow!("--set {why}"))?;
    }
    let (project, found) = knobs(project, args)?;
    if args.list {
        return Ok(Done {
            words: output::list(&found),
            json: serde_json::to_value(output::listed(&found)).unwrap_or_default(),
        });
    }
    if found.knobs.is_empty() {
        let message = "this project has no knob: no constant, macro or slider bounds a loop (--list has the reasons)";
        return Err(anyhow!(message).into());
    }
    let (pass, _) = args.error.metric.reads();
    if project.pass(&pass).is_none() {
        let why = "the project has no such pass; an error is flip, ssim, psnr, l2 PASS or a claim about a pass";
        return Err(anyhow!("--error {}: {why}", args.error.text).into());
    }
    let (media, missing) = media::gather(&project, args.run.media.as_deref());
    report.diagnose(&missing, &project.sources(), Some(&project));
    let (at, held_out) = frames(&project, args)?;
    let inputs = args.run.inputs().map_err(|why| anyhow!(why))?;
    let gpu = machine.gpu()?;
    let scene = Scene { project, media, inputs, size: args.run.canvas(), at, held_out, may_thin: args.at.is_empty() };
    let (mut earlier, mut note) = (Vec::new(), String::new());
    if let Some(path) = &args.from {
        let text = fs::read_to_string(path).with_context(|| format!("--from {}", path.display()))?;
        let result = text.lines().find_map(|line| serde_json::from_str::<Earlier>(line).ok());
        let result = result
            .ok_or_else(|| anyhow!("--from {}: no line of it is a result of eddy tune --json", path.display()))?;
        note = match (result.device == gpu.info.name, result.driver == gpu.info.driver_info) {
            (true, true) => {
                format!("started from {} settings of {}, measured again\n", result.settings.len(), path.display())
            }
            _ => format!(
                "started from {} settings that were chosen on {} ({}), measured again here\n",
                result.settings.len(),
                result.device,
                result.driver
            ),
        };
        earlier = result.settings.iter().map(|setting| setting.values_of(&found.knobs)).collect();
    }
    let request = Request {
        scene,
        knobs: found.knobs.clone(),
        bound: args.error.clone(),
        budget: args.budget,
        against_present: args.against_present,
        limit: args.time,
        earlier,
        most_knobs: (args.knob.is_empty() && args.range.is_empty()).then_some(MOST_KNOBS),
        prices: prices::kept_or_usual(&gpu, dirs::cache_dir().map(|dir| dir.join("eddy")).as_deref()),
        keeps_pictures: false,
        is_exhaustive: args.all,
    };
    let mut line = StatusLine::new(args.json);
    let tuning = tune::tune(&gpu, &request, &mut |progress| line.show(progress)).map_err(|error| match error {
        tune::TuneError::Engine(error) => RunError::from(error),
        other => RunError::Other(anyhow!(other)),
    })?;
    line.clear();
    report.frame_ms = Some(tuning.present.millis);
    report.compile_ms = Some(tuning.compile_seconds * 1e3);
    let mut words = note + &output::words(&args.project, &tuning, &found);
    if let Some(path) = &args.csv {
        write(path, tuning.csv().as_bytes(), "--csv")?;
        words += &format!("settings: {}\n", path.display());
    }
    if let Some(path) = &args.plot {
        match output::plot(&tuning)? {
            Some(svg) => {
                write(path, svg.as_bytes(), "--plot")?;
                words += &format!("plot: {}\n", path.display());
            }
            None => words += "no plot: no setting has both a time and an error above 0\n",
        }
    }
    let mut json = serde_json::to_value(output::result(&tuning, &found)).unwrap_or_default();
    if let Some(proposal) = &tuning.proposal {
        let changes = apply::Changes::new(&request, &proposal.point.values);
        words += &changes.diff();
        json["edits"] = changes.json();
        if let Some(folder) = &args.out {
            words += &changes.write_out(folder, &gpu, &request)?;
        }
        if args.apply {
            words += &changes.apply(&args.project)?;
            json["applied"] = true.into();
        } else if changes.is_any() {
            words += "nothing was written: --apply writes this edit into the project\n";
        }
    } else if args.apply {
        report.fail(
            Status::Diagnostics,
            format!("nothing was applied: no measured setting meets {}", output::goal(&tuning)),
        );
    }
    Ok(Done { words, json })
}

/// Returns the knobs that the arguments choose, and the project with fixed values.
fn knobs(project: Project, args: &TuneArgs) -> Result<(Project, Found), RunError> {
    let mut project = project;
    let mut found = Found::new(&project);
    // Fixed values are part of the program that is tuned; the edits move the places of the others.
    if !args.fix.is_empty() {
        let mut fixed: Vec<Knob> = Vec::new();
        for (name, value) in &args.fix {
            let knob = found.knob_mut(name).map_err(|why| anyhow!("--fix {why}"))?;
            if knob.kind != Kind::Setting && *value <= 0.0 {
                return Err(anyhow!("--fix {name}={value}: a value must be above 0").into());
            }
            fixed.push(knob.clone());
        }
        let values: Vec<f64> = args.fix.iter().map(|(_, value)| *value).collect();
        project = tune::applied(&project, &fixed, &values).0;
        found = Found::new(&project);
        let names: Vec<&String> = args.fix.iter().map(|(name, _)| name).collect();
        found.knobs.retain(|knob| !names.contains(&&knob.name));
    }
    for (name, range) in &args.range {
        let knob = found.knob_mut(name).map_err(|why| anyhow!("--range {why}"))?;
        knob.set_range(*range).map_err(|why| anyhow!("--range {why}"))?;
    }
    if !args.knob.is_empty() {
        found.choose(&args.knob).map_err(|why| anyhow!("--knob {why}"))?;
    } else if !args.list {
        let ranged = |knob: &Knob| args.range.iter().any(|(name, _)| *name == knob.name);
        // Where the user has chosen values, the counts do not choose knobs.
        found.keep_most(if args.range.is_empty() { MOST_FOUND } else { MOST_KNOBS }, ranged);
    }
    Ok((project, found))
}

/// Returns the frames that are compared, and those that check the result.
fn frames(project: &Project, args: &TuneArgs) -> Result<(Vec<u32>, Vec<u32>), RunError> {
    let has_state = !project.stateful_passes().is_empty();
    let (default, held_out) = default_frames(has_state, args.run.recorded());
    if args.at.is_empty() {
        return Ok((default, held_out));
    }
    let list = crate::playback::frames::FrameList::joined(&args.at).map_err(|why| anyhow!("--at: {why}"))?;
    let at: Vec<u32> = list.numbers();
    let last = at.last().copied().unwrap_or(0);
    args.run.within_recording(last + 1).map_err(|why| anyhow!(why))?;
    Ok((at, held_out.into_iter().filter(|frame| !has_state || *frame <= last.max(90)).collect()))
}

fn write(path: &std::path::Path, bytes: &[u8], option: &str) -> anyhow::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(std::path::Path::new("."));
    let name = path
        .file_name()
        .and_then(|name| name.to_str())
        .ok_or_else(|| anyhow!("{option} {}: give a file name", path.display()))?;
    project::write_into(folder, name, |file| file.write_all(bytes))
        .with_context(|| format!("{option} {}", path.display()))
}

/// Settings of an earlier result.
#[derive(Deserialize)]
struct Earlier {
    device: String,
    driver: String,
    #[serde(rename = "frontier")]
    settings: Vec<EarlierSetting>,
}

#[derive(Deserialize)]
struct EarlierSetting {
    values: BTreeMap<String, f64>,
}

impl EarlierSetting {
    /// Returns a value for each knob; knobs that the result does not have keep theirs.
    fn values_of(&self, knobs: &[Knob]) -> Vec<f64> {
        knobs.iter().map(|knob| self.values.get(&knob.name).copied().unwrap_or(knob.value)).collect()
    }
}

/// A line on standard error that is written again and again.
struct StatusLine {
    is_shown: bool,
}

impl StatusLine {
    fn new(json: bool) -> Self {
        Self { is_shown: !json && io::stderr().is_terminal() }
    }

    fn show(&mut self, progress: &Progress) -> bool {
        if self.is_shown {
            let name: String = progress.doing.chars().take(60).collect();
            terminal::replace_line(&format!("{:3.0} %  {name}", progress.part * 100.0));
        }
        true
    }

    fn clear(&mut self) {
        if self.is_shown {
            terminal::replace_line("");
        }
    }
}

impl JsonKnob {
    fn new(knob: &Knob) -> Self {
        Self {
            name: knob.name.clone(),
            place: knob.place.clone(),
            column: knob.column,
            value: knob.value,
            kind: format!("{:?}", knob.kind).to_lowercase(),
            why: knob.why.clone(),
            values: knob.ladder.values.clone(),
            finest: knob.finest,
            larger_costs_more: knob.grows,
        }
    }
}

/// The plot of a result; see [`crate::lab::report::ErrorPlot`].
fn plotted(tuning: &Tuning) -> crate::lab::report::ErrorPlot {
    let place = |point: &tune::Point| (point.millis, point.error);
    let mut marks = vec![(place(&tuning.present), "present".to_owned())];
    if let Some(proposal) = &tuning.proposal {
        let measured = tuning.points.iter().find(|point| point.values == proposal.point.values);
        marks.push((place(measured.unwrap_or(&proposal.point)), "proposed".to_owned()));
    }
    crate::lab::report::ErrorPlot {
        title: format!("{} on {}", tuning.bound, tuning.device),
        x: format!("ms per frame ({} x {}, {})", tuning.size.0, tuning.size.1, tuning.clock),
        y: tuning.metric.clone(),
        points: tuning.points.iter().map(place).collect(),
        frontier: tuning.frontier().into_iter().map(place).collect(),
        marks,
        limit: Some(tuning.limit),
    }
}
