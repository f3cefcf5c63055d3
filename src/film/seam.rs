//! A film whose end fades into its start.
//!
//! The first frames are faded with those that would follow the last one: the first frame is the one after the last, and
//! at the end of the fade only the film's own frames remain. A second engine draws the frames after the last one, so
//! that none is stored.

use super::{Rate, shrunk};
use eddy_engine::Pixels;
use eddy_playback::{
    median,
    offline::{Offline, OfflineError},
};
use eddy_project::PassName;

/// The joint of a looping film, while its frames are drawn.
pub struct Seam {
    /// Draws the frames that follow the film; `None` without a fade.
    later: Option<Offline>,
    /// `later` does not depend on which frames were drawn before.
    jumps: bool,
    /// The number of faded frames, and frames of the run per frame of the film.
    fade: u32,
    step: u32,
    /// The number of the film's frames that are done.
    done: u32,
    first: Option<Pixels>,
    last: Option<Pixels>,
    /// The distances between neighbouring frames.
    distances: Vec<f64>,
    /// The text of the verdict about the project's period.
    period: String,
}

/// The fade at a film's start, for the film's length.
#[derive(Clone, Debug, PartialEq)]
pub struct Fade {
    /// 0 for a film of whole periods: it has no seam.
    pub secs: f64,
    frames: u32,
    period: String,
}

impl Fade {
    /// Returns the fade for a film of `count` frames that is to be faded for `secs`. A film of one or more whole
    /// periods of the project, to within half a frame, is not faded. Returns an error if the fade is longer than the
    /// film.
    pub fn new(secs: f64, period: Option<f64>, rate: Rate, count: u32) -> Result<Fade, String> {
        if let Some(period) = period {
            let frames = period * rate.per_second();
            let periods = (f64::from(count) / frames).round();
            if periods >= 1.0 && (periods * frames - f64::from(count)).abs() <= 0.5 {
                let length = if periods == 1.0 { "one period".to_owned() } else { format!("{periods} periods") };
                let period = format!("; nothing is faded: the film is {length} of the project");
                return Ok(Fade { secs: 0.0, frames: 0, period });
            }
        }
        let frames = (secs * rate.per_second()).round() as u32;
        if frames > count {
            let length = f64::from(count) / rate.per_second();
            return Err(format!("the film is {length:.2} s long, and the fade cannot be longer"));
        }
        let period = period.map(|period| {
            let frames = (period * rate.per_second()).round().max(1.0);
            format!("; the project's period is {period} s: a film of {frames} frames, or a multiple, needs no fade")
        });
        Ok(Fade { secs, frames, period: period.unwrap_or_default() })
    }
}

/// The picture of a run that a film shows.
#[derive(Clone, Debug)]
pub struct ShownPass {
    pub pass: PassName,
    /// The target of a pass with several targets, or the face of a cubemap.
    pub layer: usize,
    /// The supersampling factor: the picture is drawn this many times as wide and high.
    pub factor: u32,
}

impl ShownPass {
    /// Reads the picture of the newest frame.
    pub fn read(&self, offline: &mut Offline) -> Result<Pixels, OfflineError> {
        let pixels = offline.read(&self.pass, self.layer)?;
        Ok(if self.factor == 1 { pixels } else { shrunk(&pixels, self.factor) })
    }
}

impl Seam {
    /// Starts a film of these frames, which are evenly spaced. `open` sets up a second run of the project, and
    /// `goes_on` is called before each frame that precedes the end of the film.
    pub fn open<E: From<OfflineError>>(
        fade: Fade,
        frames: &[u32],
        open: impl FnOnce() -> Result<Offline, E>,
        mut goes_on: impl FnMut() -> Result<(), E>,
    ) -> Result<Seam, E> {
        let step = frames.windows(2).next().map_or(1, |pair| pair[1] - pair[0]);
        let Fade { frames: fade, period, .. } = fade;
        let (first, last, distances) = (None, None, Vec::new());
        let mut seam = Seam { later: None, jumps: true, fade, step, done: 0, first, last, distances, period };
        if fade > 0 {
            let offline = open()?;
            seam.jumps = !offline.has_state().map_err(OfflineError::from)?;
            seam.later = Some(offline);
            let before = u64::from(frames[0]) + frames.len() as u64 * u64::from(step);
            for _ in 0..before {
                goes_on()?;
                seam.pass_over()?;
            }
        }
        Ok(seam)
    }

    /// Skips a frame of the run that is not shown.
    fn pass_over(&mut self) -> Result<(), OfflineError> {
        let Some(later) = &mut self.later else { return Ok(()) };
        if self.jumps {
            later.skip()?;
        } else {
            later.advance()?;
        }
        Ok(())
    }

    /// Returns the next frame of the film; `own` is its picture. `read` reads the picture of another run's newest
    /// frame.
    pub fn join<E: From<OfflineError>>(
        &mut self,
        own: Pixels,
        read: impl FnOnce(&mut Offline) -> Result<Pixels, E>,
    ) -> Result<Pixels, E> {
        let mut frame = own;
        if self.done < self.fade
            && let Some(later) = &mut self.later
        {
            later.draw()?;
            let next = read(later)?;
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

    /// Returns whether the film jumps from the last frame to the first, and a text about how far they are apart. Called
    /// after all frames were joined. `None` for a film of one frame.
    pub fn verdict(self) -> Option<(bool, String)> {
        let (Some(first), Some(last), Some(usual)) = (self.first, self.last, median(self.distances)) else {
            return None;
        };
        let seam = distance(&last, &first);
        let jumps = seam > 2.0 * usual + 1.0 / 255.0;
        let verdict = if jumps { "the film jumps where it begins again" } else { "the film has no visible seam" };
        let what = format!(
            "{verdict}: its last frame is {:.2} of 255 from its first one, neighbours are {:.2} apart (means of all pixels, \
             median of all pairs){}",
            seam * 255.0,
            usual * 255.0,
            self.period
        );
        Some((jumps, what))
    }
}

/// Mixes `other` into `own`, of which `part` remains.
fn fade(own: &mut Pixels, other: &Pixels, part: f32) {
    for (own, other) in own.texels.iter_mut().zip(&other.texels) {
        *own = std::array::from_fn(|n| other[n] * (1.0 - part) + own[n] * part);
    }
}

/// Returns the mean distance of red, green and blue as displayed, from 0 to 1.
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
    fn a_film_of_whole_periods_is_not_faded() {
        let fade = |secs, period, fps, count| Fade::new(secs, period, Rate::of(fps).unwrap(), count);
        assert_eq!(fade(1.0, None, 60.0, 90).unwrap(), Fade { secs: 1.0, frames: 60, period: String::new() });
        assert!(fade(2.0, None, 60.0, 90).unwrap_err().contains("1.50 s"));
        for (period, fps, count, said) in [
            (2.0, 60.0, 120, "is one period of the project"),
            (2.0, 60.0, 360, "3 periods"),
            // Twice pi is 376.99 frames.
            (std::f64::consts::TAU, 60.0, 377, "is one period of the project"),
        ] {
            // The film may be shorter than a fade that it does not need.
            let fade = fade(100.0, Some(period), fps, count).unwrap();
            assert!((fade.secs, fade.frames) == (0.0, 0) && fade.period.contains(said), "{fade:?}");
        }
        for (period, count) in [(2.0, 119), (2.0, 60), (0.001, 0), (40.0, 120)] {
            let fade = fade(0.0, Some(period), 60.0, count).unwrap();
            assert!(fade.period.contains("needs no fade"), "{fade:?}");
        }
        assert!(fade(0.5, Some(2.0), 60.0, 100).unwrap().period.contains("a film of 120 frames"));
    }

    #[test]
    fn fades_interpolate_and_distances_use_display_values() {
        let picture = |value: f32| Pixels { width: 2, height: 1, texels: vec![[value, value, value, 1.0]; 2] };
        let mut own = picture(1.0);
        fade(&mut own, &picture(0.0), 0.25);
        assert_eq!(own, picture(0.25));
        assert_eq!(distance(&own, &picture(0.75)), 0.5);
        assert_eq!(distance(&picture(f32::NAN), &picture(7.0)), 1.0);
    }
}
