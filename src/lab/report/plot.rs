//! The plot of a study: cost across, error up, both logarithmic, with a line per method through its settings.

use super::{
    axis::{Marks, decades, label, marks},
    labels,
    table::{Look, Row, TARGET, Table, sign},
};
use crate::LabError;
use plotters::{
    coord::{Shift, combinators::WithKeyPoints},
    prelude::*,
    style::{FontStyle, register_font, text_anchor},
};

const WIDTH: u32 = 1240;
/// The minimum height; a long legend makes the plot higher.
const HEIGHT: u32 = 720;
/// Width of the legend.
const LEGEND: u32 = 380;
pub(super) const FONT: &str = "sans-serif";

/// Colours that are distinguishable with colour vision deficiency (Okabe and Ito 2008), and further ones that differ in
/// brightness.
const COLOURS: [RGBColor; super::COLOURS] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(120, 80, 40),
    RGBColor(70, 70, 160),
    RGBColor(150, 20, 60),
    RGBColor(60, 120, 60),
    RGBColor(40, 40, 40),
    RGBColor(150, 110, 200),
];
/// The frontier.
pub(super) const GOLD: RGBColor = RGBColor(255, 205, 60);
const GREY: RGBColor = RGBColor(165, 168, 172);
pub(super) const INK: RGBColor = RGBColor(40, 44, 52);

/// Errors above this are drawn on the upper edge, if there are smaller ones.
const BLOWN_UP: f64 = 9.0;

type Area<B> = DrawingArea<B, Shift>;

/// Returns `None` if no point has both a cost and an error.
pub(super) fn svg(table: &Table) -> Result<Option<String>, LabError> {
    let mut text = String::new();
    let drawn = {
        let area = SVGBackend::with_string(&mut text, (WIDTH, height(table))).into_drawing_area();
        draw(&area, table)?
    };
    Ok(drawn.then_some(text))
}

/// Does the same as [`svg`], as a PNG file.
pub(super) fn png(table: &Table) -> Result<Option<Vec<u8>>, LabError> {
    let size = (WIDTH, height(table));
    let mut rgb = vec![255; (size.0 * size.1 * 3) as usize];
    let drawn = {
        let area = BitMapBackend::with_buffer(&mut rgb, size).into_drawing_area();
        draw(&area, table)?
    };
    if !drawn {
        return Ok(None);
    }
    let mut file = std::io::Cursor::new(Vec::new());
    let format = image::ImageFormat::Png;
    image::write_buffer_with_format(&mut file, &rgb, size.0, size.1, image::ExtendedColorType::Rgb8, format)
        .map_err(|e| LabError::Plot(e.to_string()))?;
    Ok(Some(file.into_inner()))
}

pub(super) fn trouble<E: std::fmt::Display>(error: E) -> LabError {
    LabError::Plot(error.to_string())
}

pub(super) fn axis((low, high): (f64, f64)) -> WithKeyPoints<LogCoord<f64>> {
    let Marks { labelled, others } = marks((low, high));
    (low..high).log_scale().with_key_points(labelled).with_light_points(others)
}

/// Registers the font. The machine's fonts are not used, so that the picture is the same everywhere.
pub(super) fn register() -> Result<(), LabError> {
    register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| LabError::Plot("the font cannot be read".into()))
}

/// Returns the label of a line of an axis.
pub(super) fn label_of(value: f64) -> String {
    label(value)
}

fn draw<B: DrawingBackend>(area: &Area<B>, table: &Table) -> Result<bool, LabError> {
    register()?;
    let places = || table.rows.iter().filter_map(Row::place);
    // Diverged results would leave no room for the others.
    let least = places().map(|p| p.1).fold(f64::INFINITY, f64::min);
    let errors = places().map(|p| p.1.min(BLOWN_UP.max(least)));
    let (Some((x0, x1)), Some((y0, y1))) = (decades(places().map(|p| p.0)), decades(errors)) else {
        return Ok(false);
    };
    let place_of = |row: &Row| row.place().map(|(x, y)| (x, y.min(y1)));
    let is_cut = places().any(|p| p.1 > y1);
    area.fill(&WHITE).map_err(trouble)?;
    let (chart_area, legend) = area.split_horizontally(WIDTH - LEGEND);
    let mut chart = ChartBuilder::on(&chart_area)
        .caption(table.study.title, (FONT, 26, &INK))
        .margin(14)
        .x_label_area_size(54)
        .y_label_area_size(76)
        .build_cartesian_2d(axis((x0, x1)), axis((y0, y1)))
        .map_err(trouble)?;
    chart
        .configure_mesh()
        .x_desc(format!("{} ({} x {} texels)", table.study.unit.label(), table.grid, table.grid))
        .y_desc(table.study.error_label())
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .label_style((FONT, 17, &INK))
        .axis_desc_style((FONT, 19, &INK))
        .bold_line_style(RGBColor(205, 208, 214))
        .light_line_style(RGBColor(238, 240, 243))
        .axis_style(INK)
        .draw()
        .map_err(trouble)?;
    let frontier = table.frontier();
    if (y0..y1).contains(&TARGET) {
        let line = [(x0, TARGET), (x1, TARGET)];
        chart.draw_series(DashedLineSeries::new(line, 6, 5, INK.mix(0.6).stroke_width(1))).map_err(trouble)?;
        let label = Text::new(
            "error 1 %",
            (x0 * 1.05, TARGET * 1.04),
            (FONT, 15, &INK)
                .into_text_style(area)
                .pos(text_anchor::Pos::new(text_anchor::HPos::Left, text_anchor::VPos::Bottom)),
        );
        chart.draw_series([label]).map_err(trouble)?;
    }
    // Wide and light, under the methods.
    let mut steps = Vec::new();
    for pair in frontier.windows(2) {
        steps.extend([pair[0], (pair[1].0, pair[0].1), pair[1]]);
    }
    let gold = GOLD.mix(0.65).stroke_width(9);
    chart.draw_series([PathElement::new(steps, gold)]).map_err(trouble)?;
    let (mut signs, mut ends) = (Vec::new(), Vec::new());
    for (n, method) in table.methods().into_iter().enumerate() {
        let colour = COLOURS[n % COLOURS.len()];
        let rows: Vec<(&Row, (f64, f64))> = table.of(method).filter_map(|r| Some((r, place_of(r)?))).collect();
        let line = rows.iter().map(|(_, place)| *place);
        chart.draw_series(LineSeries::new(line, colour.stroke_width(2))).map_err(trouble)?;
        for (row, (x, y)) in &rows {
            if let Some(times) = row.millis {
                let bar = vec![(times.min.max(x0), *y), (times.max.min(x1), *y)];
                chart.draw_series([PathElement::new(bar, colour.mix(0.6).stroke_width(1))]).map_err(trouble)?;
            }
            let body = Polygon::new(corners(n), row.look().fill(colour).filled());
            let edge = PathElement::new(corners(n), colour.stroke_width(2));
            chart.draw_series([EmptyElement::at((*x, *y)) + body + edge]).map_err(trouble)?;
        }
        signs.extend(rows.iter().map(|(_, place)| chart.backend_coord(place)));
        if let Some((_, place)) = rows.last() {
            ends.push((n, chart.backend_coord(place)));
        }
    }
    let corners = [(x0, y1), (x1, y0)].map(|corner| chart.backend_coord(&corner));
    numbers(area, &ends, &signs, corners).map_err(trouble)?;
    self::legend(&legend, table, is_cut.then_some(y1)).map_err(trouble)?;
    area.present().map_err(trouble)?;
    Ok(true)
}

/// Draws the numbers of methods at the ends of their lines, after all markers: `ends` are methods and places in pixels.
fn numbers<B: DrawingBackend>(
    area: &Area<B>,
    ends: &[(usize, (i32, i32))],
    signs: &[(i32, i32)],
    [low, high]: [(i32, i32); 2],
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let places: Vec<(i32, i32)> = ends.iter().map(|(_, place)| *place).collect();
    for (label, (n, end)) in labels::placed(&places, signs, low, high).into_iter().zip(ends) {
        let colour = COLOURS[n % COLOURS.len()];
        if label.is_led {
            let line = vec![*end, labels::nearest_side(label, *end)];
            area.draw(&PathElement::new(line, colour.mix(0.7).stroke_width(1)))?;
        }
        area.draw(&Text::new((n + 1).to_string(), label.at, (FONT, 16).into_font().color(&colour)))?;
    }
    Ok(())
}

impl Look {
    fn fill(self, colour: RGBColor) -> RGBColor {
        match self {
            Look::Full => colour,
            Look::Grey => GREY,
            Look::Hollow => WHITE,
        }
    }
}

/// Returns the corners of the nth method's marker in whole pixels.
fn corners(n: usize) -> Vec<(i32, i32)> {
    sign(n).into_iter().map(|[x, y]| (x.round() as i32, y.round() as i32)).collect()
}

const LEGEND_TOP: i32 = 62;
/// The height of the legend's text below the methods.
const LEGEND_FOOT: i32 = 205;

/// Returns the height of a method in the legend, including its settings if there are several.
fn entry_height(settings: usize) -> i32 {
    if settings > 1 { 38 } else { 27 }
}

/// Returns the height of the whole plot.
fn height(table: &Table) -> u32 {
    let entries: i32 = table.methods().into_iter().map(|m| entry_height(table.of(m).count())).sum();
    HEIGHT.max((LEGEND_TOP + entries + LEGEND_FOOT) as u32)
}

/// `cut`: the upper edge of the plot, where points above it are drawn.
fn legend<B: DrawingBackend>(
    area: &Area<B>,
    table: &Table,
    cut: Option<f64>,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let text = |size: u32, colour: &RGBColor| (FONT, size).into_font().color(colour);
    let (left, mut y) = (14, LEGEND_TOP);
    let sign = |y: i32, n: usize, colour: RGBColor, fill: RGBColor| {
        let shift = |p: (i32, i32)| (p.0 + left + 10, p.1 + y + 9);
        let at: Vec<(i32, i32)> = corners(n).into_iter().map(shift).collect();
        area.draw(&Polygon::new(at.clone(), fill.filled()))?;
        area.draw(&PathElement::new(at, colour.stroke_width(2)))
    };
    for (n, method) in table.methods().into_iter().enumerate() {
        let colour = COLOURS[n % COLOURS.len()];
        sign(y, n, colour, colour)?;
        area.draw(&Text::new(format!("{}  {}", n + 1, method.title), (left + 32, y), text(17, &INK)))?;
        let settings: Vec<String> = table.of(method).map(|r| r.point.setting.to_string()).collect();
        if settings.len() > 1 {
            area.draw(&Text::new(settings.join(", "), (left + 50, y + 19), text(14, &RGBColor(110, 114, 122))))?;
        }
        y += entry_height(settings.len());
    }
    area.draw(&Text::new(format!("settings: {}", table.study.parameter), (left, y + 4), text(15, &INK)))?;
    y += 36;
    let looks = [(INK, "best at its cost"), (GREY, "another is cheaper and closer"), (WHITE, "fails a hard case")];
    for (fill, words) in looks.into_iter().filter(|(fill, _)| table.study.is_contest || *fill == WHITE) {
        sign(y, 0, INK, fill)?;
        area.draw(&Text::new(words, (left + 32, y), text(15, &INK)))?;
        y += 25;
    }
    if table.study.is_contest {
        let gold = GOLD.mix(0.65).stroke_width(9);
        area.draw(&PathElement::new(vec![(left, y + 9), (left + 22, y + 9)], gold))?;
        area.draw(&Text::new("the frontier", (left + 32, y), text(15, &INK)))?;
    }
    area.draw(&Text::new("bars: least and most of all turns", (left, y + 27), text(15, &INK)))?;
    if let Some(edge) = cut {
        let words = format!("on the upper edge: an error above {edge}");
        area.draw(&Text::new(words, (left, y + 52), text(15, &INK)))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_differ_in_colour_or_marker() {
        let signs: Vec<_> = (0..24).map(|n| (n % COLOURS.len(), corners(n))).collect();
        assert!((0..24).all(|n| !signs[..n].contains(&signs[n])));
    }
}
