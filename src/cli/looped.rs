//! `--loop`: a film whose end goes over into its beginning.
//!
//! The first frames are faded with those that would follow the last one: the first frame is the one after the last, and at the end
//! of the fade the film's own frames remain. A second engine draws the frames after the last one, so that none is kept.

use super::{
    args::RenderArgs,
    machine::{Machine, Trouble, median, open_measured},
    report::Report,
    tiles,
};
use crate::{
    diag::{Diagnostic, Severity, SourceMap},
    engine::Pixels,
    film::Rate,
    playback::{offline::Offline, script::ScriptedInputs},
};

/// The joint of a film, while its frames are drawn.
pub struct Seam {
    /// Draws the frames that follow the film; `None` without a fade.
    later: Option<Offline>,
    /// It is nothing to `later` which frames were drawn.
    jumps: bool,
    /// Frames that are faded, and frames of the run for each of the film.
    fade: u32,
    step: u32,
    /// Frames of the film that are done.
    done: u32,
    first: Option<Pixels>,
    last: Option<Pixels>,
    /// The distances of neighbours.
    distances: Vec<f64>,
}

impl Seam {
    /// Begins with no frame of a film of these frames, which are evenly spaced.
    pub fn open(
        machine: &mut Machine,
        report: &Report,
        args: &RenderArgs,
        (secs, rate): (f64, Rate),
        frames: &[u32],
        inputs: &ScriptedInputs,
    ) -> Result<Seam, Trouble> {
        let count = frames.len() as u32;
        let fade = (secs * rate.per_second()).round() as u32;
        if fade > count {
            let length = f64::from(count) / rate.per_second();
            return Err(anyhow::anyhow!(
                "--loop {secs}: the film is {length:.2} s long, and the fade cannot be longer"
            )
            .into());
        }
        let step = frames.windows(2).next().map_or(1, |pair| pair[1] - pair[0]);
        let mut seam =
            Seam { later: None, jumps: true, fade, step, done: 0, first: None, last: None, distances: Vec::new() };
        if fade > 0 {
            // What there is to say of the project was said when it was opened first.
            let mut quiet = Report::swept(&report.project, &report.sweep);
            let wanted = (&args.pass.pass, &|_: &_| Vec::new() as Vec<_>);
            let opened = open_measured(
                machine,
                &mut quiet,
                &report.project,
                &args.drawn(),
                (wanted.0, wanted.1),
                inputs.clone(),
            );
            let (_, offline, _) = opened?;
            seam.jumps = !offline.has_state()?;
            seam.later = Some(offline);
            let before = u64::from(frames[0]) + u64::from(count) * u64::from(step);
            for _ in 0..before {
                seam.pass_over()?;
            }
        }
        Ok(seam)
    }

    /// Goes on by a frame of the run that is not shown.
    fn pass_over(&mut self) -> Result<(), Trouble> {
        let Some(later) = &mut self.later else { return Ok(()) };
        if self.jumps {
            later.skip()?;
        } else {
            later.draw()?;
        }
        Ok(())
    }

    /// Returns the next frame of the film, of which `own` is the picture.
    pub fn join(&mut self, own: Pixels, args: &RenderArgs) -> Result<Pixels, Trouble> {
        let mut frame = own;
        if self.done < self.fade
            && let Some(later) = &mut self.later
        {
            later.draw()?;
            let next = tiles::whole(later, args, None)?;
            let part = self.done as f32 / self.fade as f32;
            fade(&mut frame, &next, part);
            for _ in 1..self.step {
                self.pass_over()?;
            }
        }
        self.done += 1;
        if let Some(last) = &self.last {
            self.distances.push(distance(last, &frame));
        }
        self.first.get_or_insert_with(|| frame.clone());
        self.last = Some(frame.clone());
        Ok(frame)
    }

    /// Says how far the last frame is from the first one, now that all are there.
    pub fn report(self, report: &mut Report) {
        let (Some(first), Some(last), Some(usual)) = (self.first, self.last, median(self.distances)) else { return };
        let seam = distance(&last, &first);
        let (severity, verdict) = if seam > 2.0 * usual + 1.0 / 255.0 {
            (Severity::Warning, "the film jumps where it begins again")
        } else {
            (Severity::Note, "the film has no visible seam")
        };
        let what = format!(
            "{verdict}: its last frame is {:.2} of 255 from its first one, neighbours are {:.2} apart (means of all pixels, \
             median of all pairs)",
            seam * 255.0,
            usual * 255.0
        );
        report.diagnose(&[Diagnostic::new(severity, None, what)], &SourceMap::default(), None);
    }
}

/// Mixes a picture into another one, of which `part` remains.
fn fade(own: &mut Pixels, other: &Pixels, part: f32) {
    for (own, other) in own.texels.iter_mut().zip(&other.texels) {
        *own = std::array::from_fn(|n| other[n] * (1.0 - part) + own[n] * part);
    }
}

/// The mean distance of red, green and blue as a screen shows them, from 0 to 1.
fn distance(one: &Pixels, other: &Pixels) -> f64 {
    let shown = |v: f32| f64::from(if v > 0.0 { v.min(1.0) } else { 0.0 });
    let pairs = one.texels.iter().zip(&other.texels);
    let sum: f64 = pairs.map(|(a, b)| (0..3).map(|n| (shown(a[n]) - shown(b[n])).abs()).sum::<f64>()).sum();
    sum / (3 * one.texels.len().max(1)) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fade_goes_from_one_to_the_other_and_distances_are_those_of_a_screen() {
        let picture = |value: f32| Pixels { width: 2, height: 1, texels: vec![[value, value, value, 1.0]; 2] };
        let mut own = picture(1.0);
        fade(&mut own, &picture(0.0), 0.25);
        assert_eq!(own, picture(0.25));
        assert_eq!(distance(&own, &picture(0.75)), 0.5);
        assert_eq!(distance(&picture(f32::NAN), &picture(7.0)), 1.0);
    }
}
