//! Reports of the results: a CSV and a plot per study, and one page of all.

mod axis;
mod csv;
mod frontier;
mod html;
mod labels;
mod plot;
mod table;

use super::{LabError, Results, Study, error::make_folder};
pub use axis::{decades, tick};
pub(crate) use csv::quoted;
use eddy_project as project;
pub use frontier::ErrorPlot;
pub(crate) use html::escaped;
use std::{io::Write, path::Path};
pub use table::{Best, COLOURS, Look, Row, TARGET, Table, sign};

/// Writes `index.html` and, for each study with any result, `NAME.csv`, `NAME.svg` and `NAME.png`. Returns the names of
/// the files.
pub fn write(out: &Path, studies: &[&'static Study], results: &Results) -> Result<Vec<String>, LabError> {
    make_folder(out)?;
    let mut written = Vec::new();
    let mut save = |name: String, bytes: &[u8]| {
        let path = out.join(&name);
        project::write_into(out, &name, |file| file.write_all(bytes)).map_err(LabError::io("write", &path))?;
        written.push(name);
        Ok::<(), LabError>(())
    };
    let mut sections = Vec::new();
    for table in studies.iter().filter_map(|study| Table::new(study, results)) {
        save(format!("{}.csv", table.study.name), csv::text(&table).as_bytes())?;
        let svg = plot::svg(&table)?;
        if let Some(svg) = &svg {
            save(format!("{}.svg", table.study.name), svg.as_bytes())?;
        }
        if let Some(png) = plot::png(&table)? {
            save(format!("{}.png", table.study.name), &png)?;
        }
        sections.push((table, svg));
    }
    save("index.html".into(), html::page(&sections, results).as_bytes())?;
    Ok(written)
}
