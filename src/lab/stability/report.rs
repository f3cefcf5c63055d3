//! Reports of the results: a table for the terminal, a CSV, a page.

use super::{CheckedProject, record_name};
use crate::{
    Extent, LabError, Results,
    error::make_folder,
    page_style::PAGE,
    report::{escaped, quoted},
    stability_record::{Kind, Outcome, Recovery, StabilityRecord, short},
};
use eddy_project as project;
use std::{collections::BTreeMap, fmt::Write, io::Write as _, path::Path};

/// Returns a line for each project and kind, followed by every case that left a required range.
pub fn table(records: &[StabilityRecord]) -> String {
    let mut out = format!(
        "{:20} {:38} {:>6} {:>6} {:>10} {:>6}  {:20} {}\n",
        "project", "cases of", "drawn", "held", "as theory", "left", "slowest recovery", "cells a step"
    );
    for ((project, kind), rows) in grouped(records) {
        let count = |of: fn(&Outcome) -> bool| rows.iter().filter(|r| r.outcome.as_ref().is_some_and(of)).count();
        let left = rows.iter().filter(|r| !r.is_right()).count();
        let _ = writeln!(
            out,
            "{project:20} {:38} {:>6} {:>6} {:>10} {:>6}  {:20} {}",
            kind.title(),
            rows.len(),
            count(|o| matches!(o, Outcome::Held)),
            count(|o| matches!(o, Outcome::LeftAsExpected(_))),
            left,
            slowest(&rows),
            cells(&rows),
        );
    }
    for record in records.iter().filter(|r| !r.is_right()) {
        let _ = writeln!(out, "\n{}: {}\n    {}", record.project, record.case, what(record));
    }
    out
}

/// Writes `stability.csv` and `stability.html`; nothing if no case has been drawn. Returns the names of the files. The
/// page contains the bounds of presets: see [`write_of`].
pub fn write(out: &Path, results: &Results) -> Result<Vec<String>, LabError> {
    write_of(out, results, &[])
}

/// Does the same as [`write`], and the page also contains the bounds of `subjects`. Other projects are known only by
/// name from the results, which may be untrusted, and are not opened.
pub fn write_of(out: &Path, results: &Results, subjects: &[CheckedProject]) -> Result<Vec<String>, LabError> {
    if results.cases.is_empty() {
        return Ok(Vec::new());
    }
    make_folder(out)?;
    let files = [("stability.csv", csv(&results.cases)), ("stability.html", page(results, subjects))];
    for (name, text) in &files {
        let path = out.join(name);
        project::write_into(out, name, |file| file.write_all(text.as_bytes())).map_err(LabError::io("write", &path))?;
    }
    Ok(files.map(|(name, _)| name.to_owned()).into())
}

fn grouped(records: &[StabilityRecord]) -> BTreeMap<(&str, Kind), Vec<&StabilityRecord>> {
    let mut groups: BTreeMap<(&str, Kind), Vec<&StabilityRecord>> = BTreeMap::new();
    for record in records {
        groups.entry((&record.project, record.kind)).or_default().push(record);
    }
    groups
}

fn slowest(rows: &[&StabilityRecord]) -> String {
    let all = rows.iter().filter_map(|r| r.recovery);
    all.max_by_key(|r| match r {
        Recovery::Frames(n) => (false, *n),
        Recovery::NotWithin(n) => (true, *n),
    })
    .map_or(String::new(), recovery_text)
}

/// Returns the measured cells per step: of each case about them, otherwise the maximum.
fn cells(rows: &[&StabilityRecord]) -> String {
    let all = rows.iter().filter_map(|r| Some((r.kind, r.courant?.0)));
    let (about, others): (Vec<_>, Vec<_>) = all.partition(|(kind, _)| *kind == Kind::Courant);
    let cell = |(_, cells): &(Kind, f64)| format!("{cells:.2}");
    if about.is_empty() {
        others.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(String::new(), cell)
    } else {
        about.iter().map(cell).collect::<Vec<_>>().join(", ")
    }
}

fn recovery_text(recovery: Recovery) -> String {
    match recovery {
        Recovery::Frames(n) => format!("{n} frames"),
        Recovery::NotWithin(n) => format!("more than {n} frames"),
    }
}

/// Describes the outcome of a case.
fn what(record: &StabilityRecord) -> String {
    match (&record.trouble, record.offence()) {
        (Some(trouble), _) => trouble.clone(),
        (None, Some(offence)) => offence.describe(),
        (None, None) => "held".into(),
    }
}

fn expected(record: &StabilityRecord) -> String {
    if record.excuses.is_empty() { "holds".into() } else { format!("may leave: {}", record.excuses.join("; ")) }
}

fn outcome(record: &StabilityRecord) -> &'static str {
    match &record.outcome {
        None => "failed",
        Some(Outcome::Held) => "held",
        Some(Outcome::LeftAsExpected(_)) => "left as expected",
        Some(Outcome::Left(_)) => "left",
    }
}

const COLUMNS: &str = "project,kind,case,width,height,frames,settings,expected,outcome,frame,pass,quantity,x,y,value,low,high,count,\
                       recovery_frames,cells_a_step,trouble";

fn csv(records: &[StabilityRecord]) -> String {
    let mut out = format!("{COLUMNS}\r\n");
    for r in records {
        let at = r.offence();
        let or_empty = |x: Option<String>| x.unwrap_or_default();
        let cells = [
            r.project.clone(),
            r.kind.title().into(),
            r.case.clone(),
            r.size.0.to_string(),
            r.size.1.to_string(),
            r.frames.to_string(),
            r.settings.clone(),
            expected(r),
            outcome(r).into(),
            or_empty(at.map(|o| o.frame.to_string())),
            or_empty(at.map(|o| o.pass.clone())),
            or_empty(at.map(|o| o.quantity.clone())),
            or_empty(at.and_then(|o| o.texel).map(|t| t.0.to_string())),
            or_empty(at.and_then(|o| o.texel).map(|t| t.1.to_string())),
            or_empty(at.map(|o| o.value.0.to_string())),
            or_empty(at.map(|o| o.low.0.to_string())),
            or_empty(at.map(|o| o.high.0.to_string())),
            or_empty(at.map(|o| o.count.to_string())),
            or_empty(r.recovery.map(|r| match r {
                Recovery::Frames(n) => n.to_string(),
                Recovery::NotWithin(n) => format!(">{n}"),
            })),
            or_empty(r.courant.map(|c| short(c.0))),
            or_empty(r.trouble.clone()),
        ];
        let line: Vec<String> = cells.iter().map(|cell| quoted(cell)).collect();
        let _ = write!(out, "{}\r\n", line.join(","));
    }
    out
}

const STYLE: &str = "
th, td { padding: .25rem .55rem; text-align: left; border-bottom: 1px solid var(--rule); vertical-align: top; min-width: 3rem }
th { font-weight: 600; background: var(--head) } td.n, th.n { text-align: right; white-space: nowrap }
tr.left td { background: var(--wrong) } tr.excused td { color: var(--quiet) }
";

fn page(results: &Results, subjects: &[CheckedProject]) -> String {
    let mut out = format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Stability</title>\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><style>{PAGE}{STYLE}</style></head><body>\n<h1>Stability</h1>\n\
         <p>Each case draws a project and looks at its states every few frames, and at each frame while something is done to it. A \
         bound is the range that physics or the method allows, and not the limit of a clamp. Where theory says that a bound is \
         left, the case may leave it, and must stay finite. Frames to recover are counted from the end of what was done until \
         everything is within its bounds and at most 1.1 times as lively, as a root mean square, as without it. Cells a step \
         are what was measured: how far the fastest texel moved in one, in each of the cases about that, and the furthest in \
         the others.</p>\n"
    );
    for run in &results.runs {
        let extent = if run.extent == Extent::Quick { "a quick run" } else { "a full run" };
        let _ = writeln!(
            out,
            "<p class=\"quiet\">{} &middot; Eddy {} &middot; {extent}</p>",
            escaped(&run.driver),
            escaped(&run.version)
        );
    }
    let groups = grouped(&results.cases);
    out.push_str("<div class=\"wide\"><table><thead><tr><th>project</th><th>cases of</th><th class=\"n\">drawn</th><th class=\"n\">held</th><th class=\"n\">left, as theory says</th><th class=\"n\">left</th><th>slowest recovery</th><th class=\"n\">cells a step</th></tr></thead><tbody>\n");
    for ((project, kind), rows) in &groups {
        let count = |of: &str| rows.iter().filter(|r| outcome(r) == of).count();
        let left = rows.iter().filter(|r| !r.is_right()).count();
        let _ = writeln!(
            out,
            "<tr{}><td><a href=\"#{project}\">{project}</a></td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
             <td class=\"n\">{left}</td><td>{}</td><td class=\"n\">{}</td></tr>",
            if left > 0 { " class=\"left\"" } else { "" },
            kind.title(),
            rows.len(),
            count("held"),
            count("left as expected"),
            slowest(rows),
            cells(rows),
            project = escaped(project),
        );
    }
    out.push_str("</tbody></table></div>\n");
    let mut projects: Vec<&str> = groups.keys().map(|(project, _)| *project).collect();
    projects.dedup();
    for project in projects {
        section(&mut out, project, &results.cases, subjects);
    }
    out.push_str("</body></html>\n");
    out
}

fn section(out: &mut String, project: &str, records: &[StabilityRecord], subjects: &[CheckedProject]) {
    let _ = writeln!(out, "<h2 id=\"{0}\">{0}</h2>", escaped(project));
    let preset;
    let subject = match subjects.iter().find(|subject| subject.name == project) {
        Some(subject) => Some(subject),
        None => {
            preset = CheckedProject::preset(project).ok();
            preset.as_ref()
        }
    };
    if let Some(subject) = subject {
        bounds(out, subject);
    }
    out.push_str("<div class=\"wide\"><table><thead><tr><th>case</th><th class=\"n\">canvas</th><th class=\"n\">frames</th><th>expected</th><th>measured</th><th class=\"n\">recovery</th><th class=\"n\">cells a step</th></tr></thead><tbody>\n");
    for r in records.iter().filter(|r| r.project == project) {
        let class = match outcome(r) {
            "held" => "",
            "left as expected" => " class=\"excused\"",
            _ => " class=\"left\"",
        };
        let extremes: Vec<String> = r
            .extremes
            .iter()
            .map(|(name, (low, high))| format!("{name}: {} to {}", short(low.0), short(high.0)))
            .collect();
        let _ = writeln!(
            out,
            "<tr{class} title=\"{}\"><td>{}</td><td class=\"n\">{}x{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td>\
             <td class=\"n\">{}</td><td class=\"n\">{}</td></tr>",
            escaped(&extremes.join("\n")),
            escaped(&r.case),
            r.size.0,
            r.size.1,
            r.frames,
            escaped(&expected(r)),
            escaped(&what(r)),
            r.recovery.map_or(String::new(), recovery_text),
            r.courant.map_or(String::new(), |c| short(c.0)),
        );
    }
    out.push_str("</tbody></table></div>\n");
}

/// Returns the ranges at the sliders' defaults, and their justifications.
fn bounds(out: &mut String, subject: &CheckedProject) {
    let usual = subject.conditions(&Default::default(), (640, 360), 1.0 / 60.0, true);
    out.push_str("<details><summary>Bounds</summary><div class=\"wide\"><table><thead><tr><th>quantity</th><th class=\"n\">from</th><th class=\"n\">to</th><th>reason</th></tr></thead><tbody>\n");
    for check in &subject.checks {
        let range = check.range(&usual);
        let varies = if check.varies() { " (at the defaults, 640x360)" } else { "" };
        let _ = writeln!(
            out,
            "<tr><td>{}{varies}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td></tr>",
            escaped(&record_name(&check.quantity)),
            short(range.low),
            short(range.high),
            escaped(check.reason())
        );
    }
    out.push_str("</tbody></table></div></details>\n");
    if let Some(limit) = subject.courant.as_ref().and_then(|c| c.limit.as_ref()) {
        let _ = writeln!(out, "<p class=\"quiet\">Cells a step: {}.</p>", escaped(limit));
    }
}
