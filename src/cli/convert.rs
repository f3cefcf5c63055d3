//! `eddy convert`: writes a shader of another program as a project in Shadertoy's form.

use super::{
    args::ConvertArgs,
    command::{CommandError, Run},
    library::{is_file_name, one, read, save},
    machine::RunError,
    report::Report,
    terminal::{one_line, shown_path},
};
use crate::{
    project::{self, Project},
    translate,
};
use std::io;

impl Run for ConvertArgs {
    fn run(&mut self) -> Result<u8, CommandError> {
        Ok(convert(self)?)
    }
}

fn convert(args: &ConvertArgs) -> io::Result<u8> {
    let to = shown_path(&args.out);
    one(&args.file, |report| {
        if !args.out.is_dir() && is_file_name(&args.out) {
            return Err(anyhow::anyhow!("--out {to}: give a folder for the project").into());
        }
        let original = read(report, &args.file)?;
        let (mut project, notes) = shadertoy(report, &original)?;
        if let Some(folder) = original.origin.base_dir() {
            project::leave_home(&mut project, folder);
        }
        project.name = project::name_at(&args.out);
        save(&project, &args.out, args.force)?;
        Ok(format!("{}: converted into {to}{}", one_line(&args.file), listed(&notes)))
    })
}

/// Converts a project, and reports the errors of the new code.
pub(super) fn shadertoy(report: &mut Report, original: &Project) -> Result<(Project, Vec<String>), RunError> {
    let made = translate::shadertoy(original).map_err(|why| anyhow::anyhow!("{why}"))?;
    report.diagnose(&made.errors, &made.project.sources(), Some(&made.project));
    Ok((made.project, made.notes))
}

/// Returns the notes, each in its own line.
pub(super) fn listed(notes: &[String]) -> String {
    notes.iter().map(|note| format!("\n  {}", one_line(note))).collect()
}
