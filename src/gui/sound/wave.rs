//! Paints the waveform and the spectrum.

use super::range::{VisibleRange, step};
use crate::{
    audio::{BINS, Peaks, SAMPLE_RATE, Spectrum},
    gui::theme::Palette,
};
use egui::{Align2, FontId, Mesh, Painter, Rect, Stroke, pos2, vec2};

/// The distance of the marks of time, in points.
const MARKS: f32 = 60.0;
/// The columns of the spectrum: each shows the maximum of four bins.
const COLUMNS: usize = BINS / 4;

/// The painter, place and range of a waveform.
pub(super) struct Wave<'a> {
    pub painter: &'a Painter,
    pub palette: &'a Palette,
    pub rect: Rect,
    pub shown: VisibleRange,
}

impl Wave<'_> {
    /// Paints the left channel above, the right one below. Parts that are not made yet are omitted.
    pub(super) fn outline(&self, peaks: &Peaks) {
        let Self { painter, palette, rect, shown } = self;
        let columns = rect.width().floor().max(1.0) as usize;
        // Columns of several stretches start at a stretch, so that no single samples need to be read.
        let per_column = shown.length * f64::from(SAMPLE_RATE) / columns as f64;
        let grid = if per_column >= 4.0 * Peaks::STRETCH as f64 { Peaks::STRETCH } else { 1 };
        let frame = |column: usize| {
            let secs = shown.from + shown.length * column as f64 / columns as f64;
            (secs * f64::from(SAMPLE_RATE)) as i64 / grid * grid
        };
        let lane = rect.height() / 2.0;
        let mut mesh = Mesh::default();
        for column in 0..columns {
            let (from, to) = (frame(column), frame(column + 1));
            let Some(peak) = peaks.of(from..to.max(from + 1)) else { continue };
            let x = rect.left() + column as f32;
            for side in 0..2 {
                let middle = rect.top() + lane * (side as f32 + 0.5);
                let y = |sample: i16| middle - f32::from(sample) / 32768.0 * (lane / 2.0 - 2.0);
                // Silence is a line.
                let (top, bottom) = (y(peak.high[side]) - 0.5, y(peak.low[side]) + 0.5);
                mesh.add_colored_rect(Rect::from_min_max(pos2(x, top), pos2(x + 1.0, bottom)), palette.accent);
            }
        }
        painter.add(mesh);
    }

    /// Paints marks at round times, and the line between left and right.
    pub(super) fn scale(&self) {
        let Self { painter, palette, rect, shown } = self;
        painter.hline(rect.x_range(), rect.center().y, Stroke::new(1.0, palette.line));
        let apart = step(shown.length * f64::from(MARKS / rect.width().max(1.0)));
        let digits = if apart < 0.01 { 3 } else { usize::from(apart < 1.0) * 2 };
        let mut mark = (shown.from / apart).ceil() * apart;
        while mark < shown.from + shown.length {
            let x = self.x(mark);
            painter.vline(x, rect.y_range(), Stroke::new(1.0, palette.line.gamma_multiply(0.6)));
            let text = format!("{mark:.digits$}");
            let place = pos2(x + 3.0, rect.top() + 1.0);
            painter.text(place, Align2::LEFT_TOP, text, FontId::proportional(10.0), palette.weak);
            mark += apart;
        }
    }

    /// Paints a line at a time, if that is visible.
    pub(super) fn playhead(&self, secs: f64) {
        let x = self.x(secs);
        if self.rect.x_range().contains(x) {
            self.painter.vline(x, self.rect.y_range(), Stroke::new(1.5, self.palette.strong));
        }
    }

    pub(super) fn x(&self, secs: f64) -> f32 {
        self.rect.left() + self.rect.width() * ((secs - self.shown.from) / self.shown.length) as f32
    }

    pub(super) fn secs(&self, x: f32) -> f64 {
        self.shown.from + self.shown.length * f64::from((x - self.rect.left()) / self.rect.width().max(1.0))
    }
}

/// Paints the bytes of a spectrum from 0 to 11 kHz, -100 to -30 dB.
pub(super) fn spectrum(painter: &Painter, palette: &Palette, rect: Rect, spectrum: &Spectrum) {
    let mut mesh = Mesh::default();
    let width = rect.width() / COLUMNS as f32;
    for (column, bins) in spectrum[..BINS].chunks(BINS / COLUMNS).enumerate() {
        let level = f32::from(bins.iter().copied().max().unwrap_or_default()) / 255.0;
        let corner = pos2(rect.left() + width * column as f32, rect.bottom() - level * rect.height());
        mesh.add_colored_rect(
            Rect::from_min_max(corner, pos2(corner.x, rect.bottom()) + vec2((width - 1.0).max(0.5), 0.0)),
            palette.accent,
        );
    }
    painter.add(mesh);
}
