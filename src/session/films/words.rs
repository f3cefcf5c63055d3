//! Texts about a film in progress.

use super::{FilmProgress, FilmStage, FilmView, LiveView};
use std::time::Duration;

/// Below this speed the picture is reported to be slower than the film.
const SLOW: f64 = 0.95;

impl FilmView<'_> {
    /// Returns the text about it.
    pub fn words(&self) -> String {
        match self {
            FilmView::Live(live) => live_words(live),
            FilmView::UnderWay(progress) => progress_words(progress),
            FilmView::Done(done) => {
                let note = done.note.as_ref().map(|note| format!(". {}{}", note[..1].to_uppercase(), &note[1..]));
                let (frames, note) = (frames(done.frames), note.unwrap_or_default());
                format!("Saved {}: {frames}, {:.2} s{note}", done.path.display(), done.secs)
            }
            FilmView::Failed(why) => format!("Nothing was written: {why}"),
            FilmView::Cancelled => "Cancelled: nothing was written".into(),
        }
    }

    /// Returns its progress, from 0 to 1, if that is known.
    pub fn part(&self) -> Option<f32> {
        match self {
            FilmView::UnderWay(progress) => Some(progress.done as f32 / progress.of.max(1) as f32),
            _ => None,
        }
    }

    /// Returns whether it is not complete yet.
    pub fn is_busy(&self) -> bool {
        matches!(self, FilmView::Live(_) | FilmView::UnderWay(_))
    }
}

fn frames(count: u32) -> String {
    if count == 1 { "1 frame".into() } else { format!("{count} frames") }
}

fn live_words(live: &LiveView) -> String {
    let so_far = format!("Recording: {}, {:.1} s", frames(live.frames), live.secs);
    match live.speed {
        _ if live.is_paused => format!("{so_far}. The picture is paused, so nothing is recorded"),
        Some(speed) if speed < SLOW => format!(
            "{so_far}. Drawing and encoding take longer than the film, so the picture runs at {:.0} % of its speed; no frame is \
             left out",
            speed * 100.0
        ),
        _ => so_far,
    }
}

fn progress_words(progress: &FilmProgress) -> String {
    match progress.stage {
        FilmStage::Preparing => "Compiling the project".into(),
        FilmStage::Completing => format!("Completing the file: {} are drawn", frames(progress.done)),
        FilmStage::Drawing => {
            let left = progress.left.map(|left| format!(", {}", left_words(left))).unwrap_or_default();
            format!("{} of {}{left}", progress.done, frames(progress.of))
        }
    }
}

fn left_words(left: Duration) -> String {
    match left.as_secs_f64().ceil() as u64 {
        secs @ 0..90 => format!("{secs} s left"),
        secs @ 90..5_400 => format!("{} min left", secs.div_ceil(60)),
        secs => format!("{:.1} h left", secs as f64 / 3_600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FilmDone;

    #[test]
    fn text_names_frames_and_remaining_time() {
        let live = LiveView { frames: 1, secs: 1.0 / 60.0, speed: None, waits: false, is_paused: false };
        let of = |live| FilmView::Live(live).words();
        assert_eq!(of(live), "Recording: 1 frame, 0.0 s");
        assert_eq!(of(LiveView { speed: Some(1.02), ..live }), "Recording: 1 frame, 0.0 s");
        assert!(of(LiveView { speed: Some(0.43), ..live }).contains("43 % of its speed"));
        assert!(of(LiveView { speed: Some(0.43), is_paused: true, ..live }).ends_with("nothing is recorded"));
        let under_way = |stage, left: Option<u64>| {
            let left = left.map(Duration::from_secs);
            FilmView::UnderWay(FilmProgress { stage, done: 5, of: 20, left }).words()
        };
        assert_eq!(under_way(FilmStage::Drawing, None), "5 of 20 frames");
        assert_eq!(under_way(FilmStage::Drawing, Some(12)), "5 of 20 frames, 12 s left");
        assert_eq!(under_way(FilmStage::Drawing, Some(150)), "5 of 20 frames, 3 min left");
        assert_eq!(under_way(FilmStage::Drawing, Some(9_000)), "5 of 20 frames, 2.5 h left");
        assert_eq!(under_way(FilmStage::Completing, None), "Completing the file: 5 frames are drawn");
        let done = FilmDone { path: "/a/b.mp4".into(), frames: 120, secs: 2.0, note: Some("the film jumps".into()) };
        let done = FilmView::Done(&done);
        assert_eq!(done.words(), "Saved /a/b.mp4: 120 frames, 2.00 s. The film jumps");
        assert!(!done.is_busy() && FilmView::Live(live).is_busy());
    }
}
