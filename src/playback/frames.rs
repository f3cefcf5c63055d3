//! Lists of frame numbers as they are written on a command line: `7`, `0-59`, `0-599:2`, and several of them with commas.

/// Numbers are below this one.
const END: u32 = 1 << 30;
/// The most frames of a list: 77 hours at 60 frames per second.
const MOST: u64 = 1 << 24;

/// Frame numbers, as parts in the order in which they were written.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FrameList {
    parts: Vec<Part>,
    has_range: bool,
}

/// The numbers from `first` to `last`, `step` apart. `last` is one of them where `step` divides the distance.
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
    /// Reads `A`, `A-B` (with both ends), `A-B:S` (every `S`th of them, from `A` on), and several with commas between.
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

    /// Returns whether a part of it was written as a range.
    pub fn has_range(&self) -> bool {
        self.has_range
    }

    /// Returns the number where the list is a single one.
    pub fn single(&self) -> Option<u32> {
        match self.parts[..] {
            [Part { first, last, .. }] if first == last => Some(first),
            _ => None,
        }
    }

    /// Puts several lists together.
    pub fn joined(lists: &[FrameList]) -> Result<FrameList, String> {
        let parts = lists.iter().flat_map(|list| list.parts.clone()).collect();
        FrameList { parts, has_range: lists.iter().any(|list| list.has_range) }.check()
    }

    /// Returns the numbers, rising, each once.
    pub fn numbers(&self) -> Vec<u32> {
        let of = |part: &Part| (part.first..=part.last).step_by(part.step as usize);
        let mut numbers: Vec<u32> = self.parts.iter().flat_map(of).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }
}

/// The frames that are asked for as a number of them, or one by one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Frames {
    /// So many, from frame 0 on.
    Count(u32),
    List(FrameList),
}

impl Frames {
    /// Reads `N`, which is a number of frames, or a list of more than one number.
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
    fn a_number_of_frames_is_no_list() {
        assert_eq!(Frames::parse("60"), Ok(Frames::Count(60)));
        for list in ["0-59", "5-5", "3,8"] {
            assert_eq!(Frames::parse(list), Ok(Frames::List(FrameList::parse(list).unwrap())), "{list}");
        }
        assert!(Frames::parse("0").unwrap_err().contains("0-0"));
    }

    #[test]
    fn what_cannot_be_meant_is_refused_with_the_fix() {
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
