//! The requested frames of a call, from `--frames` and `--at`.

use super::RenderArgs;
use crate::playback::frames::{FrameList, Frames, film_step};

/// The requested frames.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct RequestedFrames {
    /// The frames to write, in ascending order, without duplicates.
    pub at: Vec<u32>,
    /// Frames that are drawn in any case: from 0 to before this one.
    pub drawn: Option<u32>,
    /// True if the frames are listed one by one.
    pub is_range: bool,
    /// The distance between two frames of a film.
    pub step: u32,
}

/// Returns an error message if the options contradict each other.
pub(super) fn of(args: &RenderArgs, is_film: bool) -> Result<RequestedFrames, String> {
    let listed = FrameList::joined(&args.at).map_err(|why| format!("--at: {why}"))?;
    let at = listed.numbers();
    let count = args.run.recorded();
    let asked = |at: Vec<u32>, drawn, is_range| RequestedFrames { at, drawn, is_range, step: 1 };
    let mut asked = match &args.frames {
        Some(Frames::List(_)) if !at.is_empty() => {
            return Err("--frames and --at both say which frames are written: leave one of them out".into());
        }
        Some(Frames::List(list)) => asked(list.numbers(), None, true),
        Some(Frames::Count(count)) => {
            if let Some(last) = at.last().filter(|last| **last >= *count) {
                return Err(format!("--at {last}: with --frames {count} the last frame is {}", count - 1));
            }
            asked(frames_of(at, *count, is_film), Some(*count), listed.has_range())
        }
        // For a list without a range, the drawn frames are the same as in earlier versions.
        None if !at.is_empty() => {
            let drawn = at.last().map(|last| last + 1).filter(|_| !listed.has_range());
            asked(at, drawn, listed.has_range())
        }
        None => match count {
            Some(count) => asked(frames_of(at, count, is_film), Some(count), false),
            None if is_film => {
                return Err("say how long the film is: --frames 600, or the frames of it, as in --frames 0-599".into());
            }
            None => asked(vec![0], Some(1), false),
        },
    };
    if args.shard.is_some() && args.at.is_empty() && matches!(args.frames, Some(Frames::Count(_))) {
        return Err("--shard: say which frames are shared out, as in --frames 0-599".into());
    }
    let last = asked.at.last().copied().unwrap_or_default();
    args.run.within_recording(asked.drawn.unwrap_or_default().max(last + 1))?;
    if is_film {
        asked.step = film_step(&asked.at)?;
    }
    Ok(asked)
}

/// Returns the frames to write out of this number of drawn frames, unless `at` lists some.
fn frames_of(at: Vec<u32>, count: u32, is_film: bool) -> Vec<u32> {
    match at.is_empty() {
        false => at,
        true if is_film => (0..count).collect(),
        true => vec![count - 1],
    }
}
