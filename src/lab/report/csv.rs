//! A study as comma-separated values (RFC 4180), one line per point.

use super::table::Table;
use std::fmt::Write;

const COLUMNS: &str = "study,method,setting,grid,ms,ms_min,ms_max,mtexel_per_s,roofline,bytes_per_texel,l1,l2,linf,order,\
                       ms_to_1_percent,best_error,ms_to_best,hard_passed,hard_cases,frontier,dominated";

pub(super) fn text(table: &Table) -> String {
    let values = table.values();
    let names: Vec<String> = values.iter().map(|v| quoted(v)).collect();
    let mut out = COLUMNS.to_owned();
    for name in names.iter().map(String::as_str).chain(["trouble"]) {
        let _ = write!(out, ",{name}");
    }
    out.push_str("\r\n");
    for row in &table.rows {
        let number = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:e}"));
        let (norms, cost) = (row.measured.as_ref().map(|m| m.norms), row.cost);
        let is_usual = row.point.setting == row.method.usual;
        let (passed, all) = row.hard();
        let best = table.best(row.method);
        let mut cells = vec![
            table.study.name.to_owned(),
            row.method.name.to_owned(),
            row.point.setting.to_string(),
            row.point.grid.to_string(),
            number(row.millis.map(|m| m.median)),
            number(row.millis.map(|m| m.min)),
            number(row.millis.map(|m| m.max)),
            number(cost.map(|c| c.megatexels_per_second())),
            number(cost.and_then(|c| c.roofline())),
            number(cost.map(|c| c.bytes_per_texel)),
            number(norms.map(|n| n.l1)),
            number(norms.map(|n| n.l2)),
            number(norms.map(|n| n.linf)),
            number(table.order(row.method).filter(|_| is_usual)),
            number(table.millis_to_target(row.method)),
            number(best.map(|b| b.error)),
            number(best.map(|b| b.millis)),
            passed.to_string(),
            all.to_string(),
            row.is_frontier.to_string(),
            row.is_dominated.to_string(),
        ];
        cells.extend(values.iter().map(|name| number(row.value(name))));
        cells.push(quoted(row.trouble.as_deref().unwrap_or_default()));
        let _ = write!(out, "{}\r\n", cells.join(","));
    }
    out
}

pub(crate) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn texts_with_commas_or_quotes_are_quoted() {
        assert_eq!(quoted("plain"), "plain");
        assert_eq!(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    }
}
