//! A page of all studies that needs no other file and no network.

use super::table::{Reach, Row, Table};
use crate::{
    Extent, Results,
    cost::{Clock, Cost, MIN_REPEATS, Times},
    page_style::PAGE,
};
use std::fmt::Write;

const STYLE: &str = "
th, td { padding: .25rem .5rem; text-align: right; border-bottom: 1px solid var(--rule); white-space: nowrap; overflow-wrap: normal }
th { font-weight: 600; line-height: 1.25; white-space: normal; vertical-align: bottom; background: var(--head) }
th:first-child, td:first-child { text-align: left } tr.study td { font-weight: 600; background: var(--group); text-align: left }
td.bad { color: var(--bad) } td.best { background: var(--best) } td small { display: block; line-height: 1.1 }
tr.study small { display: inline }
@media (max-width: 800px) { .wide svg { max-width: none; width: 900px } td:first-child { white-space: normal; min-width: 9rem } }
";

pub(super) fn page(sections: &[(Table, Option<String>)], results: &Results) -> String {
    let mut out = String::new();
    let _ = write!(
        out,
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Eddy's lab</title>\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"><style>{PAGE}{STYLE}</style></head><body>\n\
         <h1>Speed against error</h1>\n"
    );
    provenance(&mut out, sections, results);
    headline(&mut out, sections);
    for (table, svg) in sections {
        section(&mut out, table, svg.as_deref());
    }
    out.push_str("</body></html>\n");
    out
}

fn provenance(out: &mut String, sections: &[(Table, Option<String>)], results: &Results) {
    for run in &results.runs {
        let extent = if run.extent == Extent::Quick { "a quick run" } else { "a full run" };
        let _ = writeln!(
            out,
            "<p class=\"quiet\">{} &middot; Eddy {} &middot; {extent} &middot; {} turns of each method &middot; seed \
             {}{}</p>",
            escaped(&run.driver),
            escaped(&run.version),
            run.repeats,
            run.seed,
            if run.beside_window { " &middot; <b>costs measured while a window was drawing</b>" } else { "" }
        );
    }
    let clock = sections.iter().flat_map(|(t, _)| &t.rows).find_map(|r| r.cost.map(|c| c.clock));
    let how = match clock {
        Some(Clock::Timestamps) => "the device's timestamps: the sum of its passes' times",
        Some(Clock::Wall) => {
            "the wall's clock: a batch of frames is drawn without waiting, then the queue is waited for; the time by \
             the frames"
        }
        None => return,
    };
    let _ = writeln!(
        out,
        "<p class=\"quiet\">A frame's cost is by {how}. Methods of a study took turns; ms is the median turn, and \
         below it the least and the most of all: this run does not tell two methods apart whose ranges overlap. The \
         roofline is a pass that copies rgba32f in the same turns; bytes per texel are the least that the plan of a \
         frame moves for a texel of the study's grid. There is no roofline for grids so small that the copying pass takes \
         less than four times as long as a pass of one texel; <i>over 100</i> is a method whose textures move faster \
         than in the copying pass, because they stay in a cache or several are read at once.</p>"
    );
}

const COLUMNS: [&str; 11] = [
    "method",
    "setting",
    "ms",
    "Mtexel/s",
    "% of roofline",
    "bytes per texel and frame",
    "L2",
    "L&infin;",
    "order",
    "mass drift",
    "hard cases",
];

fn heading(out: &mut String, last: &[&str]) {
    out.push_str("<div class=\"wide\"><table><thead><tr>");
    for column in COLUMNS.iter().chain(last) {
        let _ = write!(out, "<th>{column}</th>");
    }
    out.push_str("</tr></thead><tbody>\n");
}

fn headline(out: &mut String, sections: &[(Table, Option<String>)]) {
    out.push_str(
        "<p>Each method at its usual setting, and the time in which it reaches an error of 1 %, between its settings; \
         (fails): only where it fails a hard case. The best error is the least of the settings that pass their hard cases; \
         where two errors cancel at the least, what finer settings keep.</p>\n",
    );
    heading(out, &["ms to 1 %", "best error"]);
    for (table, _) in sections {
        let _ = writeln!(
            out,
            "<tr class=\"study\"><td colspan=\"13\"><a href=\"#{}\">{}</a> <small>{}, {} x {} texels</small></td></tr>",
            table.study.name,
            escaped(table.study.title),
            table.study.unit.label(),
            table.grid,
            table.grid
        );
        let rivals = table.methods().into_iter().filter(|_| table.study.is_contest);
        let best = rivals.filter_map(|m| table.millis_to_target(m)).fold(f64::INFINITY, f64::min);
        for method in table.methods() {
            let Some(row) = table.usual(method) else { continue };
            let (class, reach) = match table.reach(method) {
                Reach::In(millis) if millis == best => (" class=\"best\"", number(millis)),
                Reach::In(millis) => ("", number(millis)),
                Reach::Failing(millis) => (" class=\"bad\"", format!("{} (fails)", number(millis))),
                Reach::Never => ("", "never".into()),
            };
            let best = table.best(method).map_or("<td>&ndash;</td>".into(), |best| {
                let title = format!("{} = {}, {} ms", table.study.parameter, best.setting, number(best.millis));
                format!("<td title=\"{}\">{}</td>", escaped(&title), number(best.error))
            });
            cells(out, table, row, &format!("<td{class}>{reach}</td>{best}"));
        }
    }
    out.push_str("</tbody></table></div>\n");
}

fn cells(out: &mut String, table: &Table, row: &Row, last: &str) {
    let some = |x: Option<f64>| x.map_or("&ndash;".to_owned(), number);
    let norms = row.measured.as_ref().map(|m| m.norms);
    let (passed, all) = row.hard();
    let is_usual = row.point.setting == row.method.usual;
    let order = table.order(row.method).filter(|_| is_usual);
    let is_spread = |t: &Times| t.min < t.max;
    let spread = row.millis.filter(is_spread).map(|t| format!("<small>{} – {}</small>", number(t.min), number(t.max)));
    let failed: Vec<String> =
        row.measured.iter().flat_map(|m| &m.hard).map(|h| format!("{}: {}", h.name, h.detail)).collect();
    let _ = writeln!(
        out,
        "<tr><td>{}</td><td>{}</td><td>{}{}</td><td>{}</td>{}<td>{}</td><td>{}</td><td>{}</td><td>{}</td>\
         <td>{}</td><td{} title=\"{}\">{passed}/{all}</td>{last}</tr>",
        escaped(row.trouble.as_deref().map_or(row.method.title, |t| t.lines().next().unwrap_or(t))),
        row.point.setting,
        some(row.millis.map(|m| m.median)),
        spread.unwrap_or_default(),
        some(row.cost.map(|c| c.megatexels_per_second())),
        row.cost.map_or("<td>&ndash;</td>".into(), roofline),
        some(row.cost.map(|c| c.bytes_per_texel)),
        some(norms.map(|n| n.l2)),
        some(norms.map(|n| n.linf)),
        order.map_or("&ndash;".into(), |o| format!("{o:.2}")),
        some(row.value("mass_drift")),
        if passed < all { " class=\"bad\"" } else { "" },
        escaped(&failed.join("; ")),
    );
}

/// Returns the cell of a method's share of the roofline, or the reason why there is none.
fn roofline(cost: Cost) -> String {
    match cost.roofline() {
        None => format!(
            "<td title=\"too few texels: the copying pass takes {} ms, and a pass of one texel {} ms\">&ndash;</td>",
            number(cost.copy.median),
            number(cost.empty.median)
        ),
        Some(share) if share > 1.0 => format!(
            "<td title=\"{:.0} %: its textures move faster than in the copying pass\">over 100</td>",
            100.0 * share
        ),
        Some(share) => format!("<td>{:.0}</td>", 100.0 * share),
    }
}

fn section(out: &mut String, table: &Table, svg: Option<&str>) {
    let study = table.study;
    let _ = writeln!(out, "<h2 id=\"{}\">{}</h2>\n<p>{}</p>", study.name, escaped(study.title), escaped(study.text));
    match svg {
        Some(svg) => drop(writeln!(out, "<div class=\"wide\">{svg}</div>")),
        None => out.push_str("<p>Nothing to plot yet: costs are missing.</p>\n"),
    }
    if let Some(verdict) = table.verdict() {
        let _ = writeln!(out, "<p><strong>{}</strong></p>", escaped(&verdict));
    }
    for method in table.methods() {
        let Some((best, [coarse, fine])) = table.best(method).and_then(|b| Some((b, b.turn?))) else { continue };
        let _ = writeln!(
            out,
            "<p>Between {} = {coarse} and {fine} {} passes from one side of the truth to the other: there an error of \
             time and one of space cancel, and shorter steps give back what is left of the second. Its best error is \
             what they keep, {}, not the least of the plot.</p>",
            escaped(table.study.parameter),
            escaped(method.title),
            number(best.error)
        );
    }
    if let Some(cost) = table.rows.iter().find_map(|r| r.cost) {
        let _ = writeln!(
            out,
            "<p class=\"quiet\">In the same turns a pass that copies rgba32f took {} ms ({:.2} GB/s), a pass of one \
             texel {} ms.{}</p>",
            number(cost.copy.median),
            32.0 * cost.canvas_texels / cost.copy.median / 1e6,
            number(cost.empty.median),
            if cost.repeats < MIN_REPEATS {
                format!(" <b>The run was stopped: costs are of {} turns, too few to compare by.</b>", cost.repeats)
            } else {
                String::new()
            }
        );
    }
    out.push_str("\n<details><summary>Every point</summary>\n");
    heading(out, &[]);
    for row in &table.rows {
        cells(out, table, row, "");
    }
    out.push_str("</tbody></table></div>\n");
    let values = table.values();
    if !values.is_empty() {
        let head: String = values.iter().map(|v| format!("<th>{}</th>", escaped(v))).collect();
        let _ = writeln!(
            out,
            "<div class=\"wide\"><table><thead><tr><th>method</th><th>setting</th>{head}</tr></thead><tbody>"
        );
        for row in &table.rows {
            let of = |name: &String| row.value(name).map_or("&ndash;".to_owned(), number);
            let cells: String = values.iter().map(|v| format!("<td>{}</td>", of(v))).collect();
            let _ =
                writeln!(out, "<tr><td>{}</td><td>{}</td>{cells}</tr>", escaped(row.method.title), row.point.setting);
        }
        out.push_str("</tbody></table></div>\n");
    }
    if !table.convergence.is_empty() {
        out.push_str("<div class=\"wide\"><table><thead><tr><th>L2 at the usual setting</th>");
        let grids: Vec<u32> = table.convergence[0].errors.iter().map(|(grid, _)| *grid).collect();
        let heads: String = grids.iter().map(|grid| format!("<th>{grid} x {grid}</th>")).collect();
        let _ = writeln!(out, "{heads}<th>order</th></tr></thead><tbody>");
        for c in &table.convergence {
            let cells: String = c.errors.iter().map(|(_, e)| format!("<td>{}</td>", number(*e))).collect();
            let _ = writeln!(out, "<tr><td>{}</td>{cells}<td>{:.2}</td></tr>", escaped(c.method.title), c.order);
        }
        out.push_str("</tbody></table></div>\n");
    }
    out.push_str("</details>\n");
}

/// Formats three significant digits.
fn number(x: f64) -> String {
    let size = x.abs();
    match size {
        _ if !x.is_finite() => "diverged".into(),
        _ if size == 0.0 => "0".into(),
        s if !(1e-3..1e5).contains(&s) => format!("{x:.2e}"),
        s if s < 0.1 => format!("{x:.4}"),
        s if s < 10.0 => format!("{x:.3}"),
        s if s < 100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}

pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_and_texts_are_escaped() {
        let said = [0.0, 1.0, 0.0123456, 4e-5, 12.345, 123.9, 2e6, f64::INFINITY].map(number);
        assert_eq!(said, ["0", "1.000", "0.0123", "4.00e-5", "12.3", "124", "2.00e6", "diverged"]);
        assert_eq!(escaped("a<b & \"c\""), "a&lt;b &amp; &quot;c&quot;");
    }

    #[test]
    fn unusable_rooflines_are_explained() {
        let times = |median: f64| Times { median, min: median, max: median };
        let cost = |copy: f64, frame: f64| Cost {
            frame: times(frame),
            copy: times(copy),
            empty: times(0.1),
            bytes_per_texel: 32.0,
            texels_per_texel: 1.0,
            canvas_texels: 1.0,
            repeats: 7,
            batch: 1,
            clock: Clock::Wall,
        };
        assert_eq!(roofline(cost(1.0, 2.0)), "<td>50</td>");
        assert!(roofline(cost(1.0, 0.25)).contains("400 %") && roofline(cost(1.0, 0.25)).contains(">over 100<"));
        assert!(roofline(cost(0.3, 2.0)).contains("0.300 ms") && roofline(cost(0.3, 2.0)).contains(">&ndash;<"));
    }
}
