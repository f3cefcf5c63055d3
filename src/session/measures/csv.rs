//! Writes measured numbers as a CSV table: a row for each frame, a column for each quantity.

use super::Measure;
use std::{
    collections::BTreeMap,
    io::{self, Write},
};

/// Writes all records. A cell is empty if its quantity was not measured in that frame, or its sample is not kept.
pub(super) fn write(out: &mut impl Write, measures: &[Measure]) -> io::Result<()> {
    let columns: Vec<&Measure> = measures.iter().filter(|measure| measure.quantity.is_ok()).collect();
    let mut rows: BTreeMap<i32, (f64, Vec<Option<f64>>)> = BTreeMap::new();
    for (column, measure) in columns.iter().enumerate() {
        for sample in measure.record.samples() {
            let row = rows.entry(sample.frame).or_insert_with(|| (sample.time_secs, vec![None; columns.len()]));
            row.1[column] = Some(sample.value);
        }
    }
    write!(out, "frame,time")?;
    for (column, measure) in columns.iter().enumerate() {
        let others = || columns.iter().enumerate().filter(|(other, _)| *other != column);
        let is_alone = others().all(|(_, other)| other.text != measure.text);
        let name = if is_alone { measure.text.clone() } else { format!("{} {}", measure.text, measure.whereabouts()) };
        write!(out, ",{}", quoted(&name))?;
    }
    writeln!(out)?;
    for (frame, (time_secs, values)) in rows {
        write!(out, "{frame},{time_secs:?}")?;
        for value in values {
            match value {
                Some(value) => write!(out, ",{value:?}")?,
                None => write!(out, ",")?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Returns a text, quoted as RFC 4180 requires.
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
