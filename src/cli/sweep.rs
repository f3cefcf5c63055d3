//! `--sweep`: draws a project once for each value of a uniform, or for every combination of several.

use std::collections::BTreeSet;

/// The values of a uniform, in the syntax of `--set`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sweep {
    name: String,
    values: Vec<String>,
}

/// The maximum number of values of a range.
const MOST: u32 = 1 << 20;

impl Sweep {
    /// Parses `NAME=VALUE;VALUE` or `NAME=LOW..HIGH:COUNT`, with `:log` after that for even ratios.
    pub(super) fn parse(text: &str) -> Result<Sweep, String> {
        let shape =
            || "write a sweep as NAME=VALUE;VALUE or NAME=LOW..HIGH:COUNT, as in viscosity=0..0.01:5".to_owned();
        let (name, values) = text.split_once('=').ok_or_else(shape)?;
        let (name, values) = (name.trim(), values.trim());
        if name.is_empty() || values.is_empty() {
            return Err(shape());
        }
        let values: Vec<String> = match values.split_once("..") {
            Some((low, rest)) => range(low, rest)?,
            None => values.split(';').map(|value| value.trim().to_owned()).collect(),
        };
        if values.iter().any(String::is_empty) {
            return Err(shape());
        }
        // Files are named after them, and not every file system distinguishes a from A.
        let mut seen = BTreeSet::new();
        match values.iter().find(|value| !seen.insert(value.to_lowercase())) {
            Some(twice) => Err(format!("{twice} is listed twice, which would give two files the same name")),
            None => Ok(Sweep { name: name.to_owned(), values }),
        }
    }
}

fn range(low: &str, rest: &str) -> Result<Vec<String>, String> {
    let number = |text: &str| match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("the ends of a range must be numbers, not \"{}\"", text.trim())),
    };
    let (high, count) = rest.split_once(':').ok_or("a range needs a count: LOW..HIGH:COUNT")?;
    let (count, scale) = match count.split_once(':') {
        None => (count, None),
        Some((count, scale)) => (count, Some(scale.trim())),
    };
    let (low, high) = (number(low)?, number(high)?);
    let count = match count.trim().parse() {
        Ok(count @ 2..=MOST) => count,
        _ => return Err(format!("a range has 2 to {MOST} values, not \"{}\"", count.trim())),
    };
    let part = |k: u32| f64::from(k) / f64::from(count - 1);
    let value = |k: u32| match scale {
        _ if k == 0 => low,
        _ if k == count - 1 => high,
        None => low + (high - low) * part(k),
        Some(_) => low * (high / low).powf(part(k)),
    };
    match scale {
        None => {}
        Some("log") if low > 0.0 && high > 0.0 => {}
        Some("log") => return Err("the ends of a logarithmic range must be above 0".into()),
        Some(other) => return Err(format!("after the count only :log is allowed, not \"{other}\"")),
    }
    Ok((0..count).map(|k| short(value(k))).collect())
}

/// Formats a value with nine significant digits, to keep file names readable.
fn short(value: f64) -> String {
    format!("{value:.8e}").parse::<f64>().unwrap_or(value).to_string()
}

/// Returns every combination of the sweeps' values, each as assignments for `--set`; the last sweep changes first.
/// Without a sweep, one combination without assignments.
pub(super) fn combinations(sweeps: &[Sweep]) -> Result<Vec<Vec<String>>, String> {
    let mut names = BTreeSet::new();
    if let Some(twice) = sweeps.iter().find(|sweep| !names.insert(&sweep.name)) {
        return Err(format!("--sweep: {} is listed twice", twice.name));
    }
    let count = sweeps.iter().map(|s| s.values.len() as u64).try_fold(1u64, u64::checked_mul);
    if count.is_none_or(|count| count > u64::from(MOST)) {
        return Err(format!("--sweep: more than {MOST} combinations"));
    }
    let mut all = vec![Vec::new()];
    for sweep in sweeps {
        let with = |before: &Vec<String>, value: &String| {
            let mut next = before.clone();
            next.push(format!("{}={value}", sweep.name));
            next
        };
        all = all.iter().flat_map(|before| sweep.values.iter().map(move |value| with(before, value))).collect();
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        Sweep::parse(text).unwrap().values
    }

    #[test]
    fn lists_and_ranges_are_parsed() {
        assert_eq!(values("tint=1,0,0; 0,1,0"), ["1,0,0", "0,1,0"]);
        assert_eq!(values("v=0..0.3:4"), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(values("v=5..1:3"), ["5", "3", "1"]);
        assert_eq!(values("v=-1..-0.5:2"), ["-1", "-0.5"]);
        assert_eq!(values("v=0.001..1:4:log"), ["0.001", "0.01", "0.1", "1"]);
        for (text, says) in [
            ("v", "NAME=LOW..HIGH:COUNT"),
            ("=1;2", "NAME=VALUE;VALUE"),
            ("v=1;;2", "NAME=VALUE;VALUE"),
            ("v=0..1", "needs a count"),
            ("v=0..1:1", "2 to"),
            ("v=a..1:3", "not \"a\""),
            ("v=0..inf:3", "not \"inf\""),
            ("v=0..1:3:log", "above 0"),
            ("v=0..1:3:lin", ":log"),
            ("v=true;True", "twice"),
            ("v=1..1:3", "twice"),
        ] {
            let message = Sweep::parse(text).expect_err(text);
            assert!(message.contains(says), "{text}: {message}");
        }
    }

    #[test]
    fn sweeps_combine() {
        let sweep = |text: &str| Sweep::parse(text).unwrap();
        let all = combinations(&[sweep("a=1;2"), sweep("b=x;y")]).unwrap();
        assert_eq!(all, [["a=1", "b=x"], ["a=1", "b=y"], ["a=2", "b=x"], ["a=2", "b=y"]]);
        assert_eq!(combinations(&[]).unwrap(), [Vec::<String>::new()]);
        assert!(combinations(&[sweep("a=1;2"), sweep("a=3;4")]).unwrap_err().contains("twice"));
        let many = sweep("a=0..1:1000000");
        let other = Sweep { name: "b".into(), ..many.clone() };
        assert!(combinations(&[many, other]).unwrap_err().contains("combinations"));
    }
}
