//! Lists of frame numbers on the command line: `7`, `0-59`, `0-599:2`, and several of them separated by commas.

/// The exclusive upper bound of frame numbers.
const END: u32 = 1 << 30;
/// The maximum length of a list: 77 hours at 60 frames per second.
const MOST: u64 = 1 << 24;

/// Frame numbers, as ranges in the order in which they were written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameList {
    parts: Vec<Part>,
    has_range: bool,
}

/// The numbers from `first` to `last` in steps of `step`. `last` is included if `step` divides the distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Part {
    first: u32,
    last: u32,
    step: u32,
}

impl Part {
    fn count(self) -> u64 {
        u64::from((self.last - self.first) / self.step) + 1
    }
}

impl FrameList {
    /// Parses `A`, `A-B` (inclusive), `A-B:S` (every `S`th of them, from `A` on), and several separated by commas.
    pub fn parse(text: &str) -> Result<FrameList, String> {
        let parts = text.split(',').map(part).collect::<Result<Vec<_>, _>>()?;
        FrameList { parts, has_range: text.contains('-') }.check()
    }

    fn check(self) -> Result<FrameList, String> {
        match self.parts.iter().map(|part| part.count()).sum::<u64>() {
            count if count > MOST => Err(format!("{count} frames are more than {MOST}, the most of one call")),
            _ => Ok(self),
        }
    }

    /// Parses the frames of a film with this frame rate: a count from frame 0 on (`600`), a list as for
    /// [`FrameList::parse`], or a time: `10s`, `2.5s-10s`, `0s-10s:2`. The end of a time is exclusive, so that `0s-1s`
    /// has as many frames as a second.
    pub fn of_film(text: &str, fps: f64) -> Result<FrameList, String> {
        let text = text.trim();
        if !text.contains('s') {
            return match Frames::parse(text)? {
                Frames::List(list) => Ok(list),
                Frames::Count(count) => FrameList::parse(&format!("0-{}", count - 1)),
            };
        }
        let form = || format!("\"{text}\" is not a time: write it as in 10s or 2.5s-10s");
        let (range, step) = match text.split_once(':') {
            Some((range, step)) => (range, format!(":{step}")),
            None => (text, String::new()),
        };
        let secs = |text: &str| {
            let number = text.trim().strip_suffix('s').and_then(|text| text.trim().parse::<f64>().ok());
            number.filter(|secs| secs.is_finite() && *secs >= 0.0).ok_or_else(form)
        };
        let (from, to) = match range.split_once('-') {
            Some((from, to)) => (secs(from)?, secs(to)?),
            None => (0.0, secs(range)?),
        };
        // A time within a thousandth of a frame is rounded to it: 0.1 s at 30 frames per second are 3.
        let first_at = |secs: f64| (secs * fps - 1e-3).ceil().max(0.0);
        let (first, end) = (first_at(from), first_at(to));
        if end <= first {
            return Err(format!("{text}: there is no frame in that time; the end comes after the start"));
        }
        if end > f64::from(END) {
            return Err(format!("{text}: numbers of frames are below {END}"));
        }
        FrameList::parse(&format!("{}-{}{step}", first as u32, end as u32 - 1))
    }

    /// Returns whether a part of it was written as a range.
    pub fn has_range(&self) -> bool {
        self.has_range
    }

    /// Returns the number if the list has only one.
    pub fn single(&self) -> Option<u32> {
        match self.parts[..] {
            [Part { first, last, .. }] if first == last => Some(first),
            _ => None,
        }
    }

    /// Concatenates several lists.
    pub fn joined(lists: &[FrameList]) -> Result<FrameList, String> {
        let parts = lists.iter().flat_map(|list| list.parts.clone()).collect();
        FrameList { parts, has_range: lists.iter().any(|list| list.has_range) }.check()
    }

    /// Returns the distinct numbers in ascending order.
    pub fn numbers(&self) -> Vec<u32> {
        let of = |part: &Part| (part.first..=part.last).step_by(part.step as usize);
        let mut numbers: Vec<u32> = self.parts.iter().flat_map(of).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

/// Returns the spacing of a film's frames, which are in ascending order. Fails if they are not evenly spaced.
pub fn film_step(frames: &[u32]) -> Result<u32, String> {
    let step = frames.windows(2).next().map_or(1, |pair| pair[1] - pair[0]);
    match frames.windows(2).all(|pair| pair[1] - pair[0] == step) {
        true => Ok(step),
        false => {
            Err("a film shows each frame for the same time: write its frames as one range, as in 0-599 or 0-599:2"
                .into())
        }
    }
}

/// A frame of a run on the way to the requested ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    pub frame: u32,
    pub is_wanted: bool,
    /// It need not be drawn: no later frame depends on it.
    pub is_skipped: bool,
}

/// Returns the frames of a run up to the last one. `wanted` is in ascending order; `jumps`: no frame depends on
/// another.
pub fn steps(range: std::ops::Range<u32>, wanted: &[u32], jumps: bool) -> impl Iterator<Item = Step> {
    range.map(move |frame| {
        let is_wanted = wanted.binary_search(&frame).is_ok();
        Step { frame, is_wanted, is_skipped: jumps && !is_wanted }
    })
}

/// The requested frames, as a count or a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Frames {
    /// This many, from frame 0 on.
    Count(u32),
    List(FrameList),
}

impl Frames {
    /// Parses `N`, which is a count, or a list of more than one number.
    pub fn parse(text: &str) -> Result<Frames, String> {
        let is_number = !text.contains([',', '-', ':']);
        match FrameList::parse(text)? {
            list if !is_number => Ok(Frames::List(list)),
            list => match list.single() {
                Some(0) | None => Err("a number of frames is at least 1; frame 0 alone is 0-0".into()),
                Some(count) => Ok(Frames::Count(count)),
            },
        }
    }
}

fn part(text: &str) -> Result<Part, String> {
    let form = || format!("\"{text}\" is not a frame or a range: write them as in 7, 0-59, 0-599:2 or 3,8,20-30");
    let number = |text: &str| match text.trim().parse::<u32>() {
        Ok(n) if n < END => Ok(n),
        Ok(_) => Err(format!("frame {}: numbers of frames are below {END}", text.trim())),
        Err(_) => Err(form()),
    };
    let (range, step) = match text.split_once(':') {
        Some((range, step)) if range.contains('-') => (range, Some(number(step)?)),
        Some(_) => return Err(form()),
        None => (text, None),
    };
    let (first, last) = match range.split_once('-') {
        Some((first, last)) => (number(first)?, number(last)?),
        None => (number(range)?, number(range)?),
    };
    let step = step.unwrap_or(1);
    if last < first {
        return Err(format!("{text}: the range ends before it begins; write {last}-{first}"));
    }
    if step == 0 {
        return Err(format!("{text}: the step of a range is at least 1"));
    }
    Ok(Part { first, last, step })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Vec<u32> {
        FrameList::parse(text).unwrap().numbers()
    }

    #[test]
    fn ranges_have_both_ends_and_lists_are_sorted() {
        assert_eq!(numbers("7"), [7]);
        assert_eq!(numbers("2-5"), [2, 3, 4, 5]);
        assert_eq!(numbers("2-9:3"), [2, 5, 8]);
        assert_eq!(numbers("2-7:3"), [2, 5], "the end is not one of the steps");
        assert_eq!(numbers("8,2, 2-3 ,0-8:4"), [0, 2, 3, 4, 8]);
        assert_eq!(numbers("1073741823-1073741823"), [1_073_741_823]);
        let joined = FrameList::joined(&[FrameList::parse("4").unwrap(), FrameList::parse("1-2").unwrap()]);
        assert_eq!(joined.unwrap().numbers(), [1, 2, 4]);
    }

    #[test]
    fn single_number_is_a_count() {
        assert_eq!(Frames::parse("60"), Ok(Frames::Count(60)));
        for list in ["0-59", "5-5", "3,8"] {
            assert_eq!(Frames::parse(list), Ok(Frames::List(FrameList::parse(list).unwrap())), "{list}");
        }
        assert!(Frames::parse("0").unwrap_err().contains("0-0"));
    }

    #[test]
    fn film_frames_are_a_count_a_list_or_a_time() {
        let of = |text: &str, fps: f64| FrameList::of_film(text, fps).map(|list| list.numbers());
        assert_eq!(of("3", 60.0), Ok(vec![0, 1, 2]));
        assert_eq!(of("2-4", 60.0), Ok(vec![2, 3, 4]));
        assert_eq!(of("0.1s", 30.0), Ok(vec![0, 1, 2]));
        assert_eq!(of("1s - 1.5s", 4.0), Ok(vec![4, 5]));
        assert_eq!(of("0s-1s:2", 4.0), Ok(vec![0, 2]));
        assert_eq!(of("10s", 60.0).map(|frames| frames.len()), Ok(600));
        assert_eq!(of("1s", 29.97).map(|frames| frames.len()), Ok(30), "the last one begins within the second");
        for (text, says) in [
            ("s", "2.5s-10s"),
            ("5s-", "2.5s-10s"),
            ("-5s", "2.5s-10s"),
            ("1s-2", "2.5s-10s"),
            ("infs", "2.5s-10s"),
            ("2s-1s", "no frame"),
            ("0s", "no frame"),
            ("1e12s", "below"),
            ("99999999s", "below"),
            ("0s-1s:0", "at least 1"),
            ("0", "at least 1"),
        ] {
            let message = of(text, 60.0).expect_err(text);
            assert!(message.contains(says), "{text}: {message}");
        }
    }

    #[test]
    fn run_skips_frames_that_no_other_depends_on() {
        let of = |jumps| steps(0..4, &[1, 3], jumps).map(|s| (s.frame, s.is_wanted, s.is_skipped)).collect::<Vec<_>>();
        assert_eq!(of(true), [(0, false, true), (1, true, false), (2, false, true), (3, true, false)]);
        assert!(of(false).iter().all(|step| !step.2));
        assert_eq!((film_step(&[3, 5, 7]), film_step(&[4])), (Ok(2), Ok(1)));
        assert!(film_step(&[1, 2, 4]).is_err());
    }

    #[test]
    fn invalid_lists_are_rejected_with_the_fix() {
        for (text, says) in [
            ("", "0-59"),
            ("a", "\"a\""),
            ("1,,2", "0-59"),
            ("-1", "0-59"),
            ("1-", "0-59"),
            ("1-2-3", "0-59"),
            ("9-2", "write 2-9"),
            ("1:2", "0-59"),
            ("1-9:0", "at least 1"),
            ("1-9:", "0-59"),
            ("1-9:2:2", "0-59"),
            ("1073741824", "below 1073741824"),
            ("0-99999999", "the most of one call"),
            ("0-9999999,0-9999999", "the most of one call"),
        ] {
            let message = FrameList::parse(text).expect_err(text);
            assert!(message.contains(says), "{text}: {message}");
        }
    }
}
