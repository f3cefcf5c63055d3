//! A plot of error against cost for any set of measurements, in the look of the studies' plots.

use super::{
    axis::decades,
    plot::{FONT, GOLD, INK, axis, label_of, register, trouble},
};
use crate::LabError;
use plotters::prelude::*;

/// Measurements, and those of them that are marked.
#[derive(Clone, Debug)]
pub struct ErrorPlot {
    pub title: String,
    /// The labels of the axes.
    pub x: String,
    pub y: String,
    /// Cost and error.
    pub points: Vec<(f64, f64)>,
    /// Those that no other beats, in ascending order of cost.
    pub frontier: Vec<(f64, f64)>,
    pub marks: Vec<((f64, f64), String)>,
    /// The error that is allowed.
    pub limit: Option<f64>,
}

const SIZE: (u32, u32) = (860, 600);
/// Errors of 0 are drawn this many times below the least other one.
const ZERO: f64 = 0.3;

impl ErrorPlot {
    /// Returns `None` if no point has a cost and an error above 0.
    pub fn svg(&self) -> Result<Option<String>, LabError> {
        let is_shown = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite() && *x > 0.0;
        let shown: Vec<(f64, f64)> = self.points.iter().copied().filter(is_shown).collect();
        let least = shown.iter().map(|p| p.1).filter(|y| *y > 0.0).fold(f64::INFINITY, f64::min);
        if !least.is_finite() {
            return Ok(None);
        }
        let lifted = |(x, y): (f64, f64)| (x, y.max(least * ZERO));
        let ends = (decades(shown.iter().map(|p| p.0)), decades(shown.iter().map(|p| lifted(*p).1).chain(self.limit)));
        let (Some((x0, x1)), Some((y0, y1))) = ends else { return Ok(None) };
        // Whole decades of time leave most of a plot empty.
        let within = |f: fn(f64, f64) -> f64, from: f64| shown.iter().map(|p| p.0).fold(from, f);
        let (x0, x1) = (x0.max(within(f64::min, x1) / 1.5), x1.min(within(f64::max, x0) * 1.5));
        register()?;
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
            area.fill(&WHITE).map_err(trouble)?;
            let mut chart = ChartBuilder::on(&area)
                .caption(&self.title, (FONT, 22, &INK))
                .margin(14)
                .x_label_area_size(54)
                .y_label_area_size(76)
                .build_cartesian_2d(axis((x0, x1)), axis((y0, y1)))
                .map_err(trouble)?;
            chart
                .configure_mesh()
                .x_desc(&self.x)
                .y_desc(&self.y)
                .x_label_formatter(&|x| label_of(*x))
                .y_label_formatter(&|y| label_of(*y))
                .label_style((FONT, 16, &INK))
                .axis_desc_style((FONT, 17, &INK))
                .bold_line_style(RGBColor(205, 208, 214))
                .light_line_style(RGBColor(238, 240, 243))
                .axis_style(INK)
                .draw()
                .map_err(trouble)?;
            if let Some(limit) = self.limit.filter(|limit| (y0..y1).contains(limit)) {
                let line = [(x0, limit), (x1, limit)];
                let dashed = DashedLineSeries::new(line, 6, 5, INK.mix(0.6).stroke_width(1));
                chart.draw_series(dashed).map_err(trouble)?;
            }
            let mut steps = Vec::new();
            for pair in self.frontier.windows(2) {
                let [a, b] = [lifted(pair[0]), lifted(pair[1])];
                steps.extend([a, (b.0, a.1), b]);
            }
            chart.draw_series([PathElement::new(steps, GOLD.mix(0.65).stroke_width(7))]).map_err(trouble)?;
            let dot = |p: &(f64, f64)| Circle::new(lifted(*p), 4, RGBColor(0, 114, 178).mix(0.8).filled());
            chart.draw_series(shown.iter().map(dot)).map_err(trouble)?;
            for (place, name) in self.marks.iter().filter(|(place, _)| is_shown(place)) {
                let at = lifted(*place);
                let ring = Circle::new(at, 8, RGBColor(213, 94, 0).stroke_width(2));
                chart.draw_series([ring]).map_err(trouble)?;
                let label =
                    EmptyElement::at(at) + Text::new(name.clone(), (11, -9), (FONT, 15).into_font().color(&INK));
                chart.draw_series([label]).map_err(trouble)?;
            }
            area.present().map_err(trouble)?;
        }
        Ok(Some(text))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_marks_and_the_limit_are_drawn_or_there_is_no_plot() {
        let points = vec![(4.0, 0.0), (2.0, 0.01), (1.0, 0.2), (f64::NAN, 0.1)];
        let plot = ErrorPlot {
            title: "a & b".into(),
            x: "ms".into(),
            y: "FLIP".into(),
            frontier: vec![points[2], points[1], points[0]],
            marks: vec![(points[1], "present".into())],
            points,
            limit: Some(0.02),
        };
        let svg = plot.svg().unwrap().unwrap();
        assert_eq!(svg.matches("<circle").count(), 3 + 1, "the one without a time is left out");
        assert!(svg.contains("present") && svg.contains("FLIP") && svg.contains("a &amp; b"));
        assert!(ErrorPlot { points: vec![(1.0, 0.0)], ..plot }.svg().unwrap().is_none());
    }
}
