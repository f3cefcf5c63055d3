//! The distribution of work over several machines, and this machine's part.

use std::ops::Range;

/// Part `index` of `count`, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub index: u64,
    pub count: u64,
}

/// An invalid shard, or one that no scheduler defines. The text follows the option's name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct ShardError(String);

/// The environment variables by which a scheduler's array job tells a task its index.
struct Scheduler {
    name: &'static str,
    index: &'static str,
    /// The number of tasks, by the first of these that is set; empty if the scheduler does not provide it.
    counts: &'static [&'static str],
    /// The index of the first task, if arrays may start anywhere, that of the last, and the step between two.
    first: Option<&'static str>,
    last: Option<&'static str>,
    step: Option<&'static str>,
    /// The index of the first task if it is fixed.
    begins_at: u64,
}

/// In the order in which they are queried. GNU parallel comes first: it also runs within tasks of the others.
const SCHEDULERS: [Scheduler; 4] = [
    // Job numbers count from 1: `man parallel`, "PARALLEL_SEQ".
    Scheduler {
        name: "GNU parallel",
        index: "PARALLEL_SEQ",
        counts: &[],
        first: None,
        last: None,
        step: None,
        begins_at: 1,
    },
    // <https://slurm.schedmd.com/job_array.html>
    Scheduler {
        name: "Slurm",
        index: "SLURM_ARRAY_TASK_ID",
        counts: &["SLURM_ARRAY_TASK_COUNT"],
        first: Some("SLURM_ARRAY_TASK_MIN"),
        last: Some("SLURM_ARRAY_TASK_MAX"),
        step: Some("SLURM_ARRAY_TASK_STEP"),
        begins_at: 0,
    },
    // <https://docs.aws.amazon.com/batch/latest/userguide/job_env_vars.html>
    Scheduler {
        name: "AWS Batch",
        index: "AWS_BATCH_JOB_ARRAY_INDEX",
        counts: &["AWS_BATCH_JOB_ARRAY_SIZE"],
        first: None,
        last: None,
        step: None,
        begins_at: 0,
    },
    // An indexed Job of Kubernetes has no count; its manifest may pass `completions`.
    Scheduler {
        name: "Kubernetes",
        index: "JOB_COMPLETION_INDEX",
        counts: &["JOB_COMPLETION_COUNT", "JOB_COMPLETIONS"],
        first: None,
        last: None,
        step: None,
        begins_at: 0,
    },
];

impl Shard {
    /// All of the work.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    /// Parses `i/n`, counted from 0, `auto`, which queries the scheduler's environment with `variable`, or `auto/n`,
    /// for schedulers that do not provide the number of tasks.
    pub fn parse(text: &str, variable: impl Fn(&str) -> Option<String>) -> Result<Shard, ShardError> {
        let form = || ShardError(format!("{text}: a shard is written i/n, from 0/n, auto or auto/n"));
        let number = |t: &str| t.trim().parse::<u64>().map_err(|_| form());
        match text.split_once('/') {
            None if text == "auto" => Self::of_scheduler(None, variable),
            None => Err(form()),
            Some(("auto", count)) => Self::of_scheduler(Some(number(count)?), variable),
            Some((index, count)) => Self::new(number(index)?, number(count)?),
        }
    }

    fn new(index: u64, count: u64) -> Result<Shard, ShardError> {
        if index >= count {
            return Err(ShardError(format!("{index}/{count}: of {count} shards the last is {}", count.max(1) - 1)));
        }
        Ok(Shard { index, count })
    }

    fn of_scheduler(wanted: Option<u64>, variable: impl Fn(&str) -> Option<String>) -> Result<Shard, ShardError> {
        let number = |name: &str| match variable(name) {
            None => Ok(None),
            Some(text) => match text.trim().parse::<u64>() {
                Ok(n) => Ok(Some(n)),
                Err(_) => Err(ShardError(format!("auto: {name} is {text:?}, not a number"))),
            },
        };
        let optional = |name: Option<&str>| name.map_or(Ok(None), number);
        for Scheduler { name, index, counts, first, last, step, begins_at } in SCHEDULERS {
            let Some(id) = number(index)? else { continue };
            let counted = counts.iter().find_map(|count| number(count).transpose()).transpose()?;
            let count = match (wanted, counted) {
                (Some(wanted), Some(counted)) if wanted != counted => {
                    let what = format!("auto/{wanted}: {name} says that there are {counted} tasks");
                    return Err(ShardError(format!("{what}; write auto/{counted}, or auto")));
                }
                (Some(count), _) | (None, Some(count)) => count,
                // Another scheduler may provide both.
                (None, None) => continue,
            };
            let (first, step) = (optional(first)?.unwrap_or(begins_at), optional(step)?.unwrap_or(1).max(1));
            let uneven = || {
                let array = format!("task {id} of an array from {first} in steps of {step}, with {count} tasks");
                ShardError(format!(
                    "auto: {index}: {array}, is not evenly spaced; use an array from 0 on, as in 0-{}",
                    count.max(1) - 1
                ))
            };
            // For a list, as in --array=3,7, Slurm reports a step of 1, and no task knows the others.
            if let Some(last) = optional(last)?
                && last.checked_sub(first).map(|distance| distance / step) != count.checked_sub(1)
            {
                return Err(ShardError(format!(
                    "auto: {name}: {count} tasks from {first} to {last} in steps of {step} are a list and not a range; use \
                     an array from 0 on, as in 0-{}",
                    count.max(1) - 1
                )));
            }
            let place = id.checked_sub(first).filter(|distance| distance.is_multiple_of(step)).ok_or_else(uneven)?;
            return if place / step < count { Self::new(place / step, count) } else { Err(uneven()) };
        }
        let set = SCHEDULERS.iter().find(|scheduler| variable(scheduler.index).is_some());
        Err(ShardError(match set {
            Some(Scheduler { name, index, counts, .. }) => {
                let missing = match counts {
                    [] => String::new(),
                    counts => format!(" ({} is not set)", counts.join(" or ")),
                };
                format!(
                    "auto: {name} says by {index} which task this is, but not how many there are{missing}: write auto/n"
                )
            }
            None => {
                let names: Vec<String> = SCHEDULERS.iter().map(|s| format!("{} ({})", s.index, s.name)).collect();
                format!(
                    "auto: no scheduler says which task this is: none of {} is set; write i/n, from 0/n",
                    names.join(", ")
                )
            }
        }))
    }

    /// Returns whether the `n`th piece of work is this shard's, if shards take turns.
    pub fn owns(&self, n: usize) -> bool {
        n as u64 % self.count == self.index
    }

    /// Returns this shard's part of this many pieces of work, if each shard is contiguous. Shards differ by at most one
    /// piece.
    pub fn part_of(&self, pieces: u64) -> Range<u64> {
        let border = |index: u64| (u128::from(pieces) * u128::from(index) / u128::from(self.count)) as u64;
        border(self.index)..border(self.index + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shard_of(text: &str, variables: &[(&str, &str)]) -> Result<Shard, String> {
        let get = |name: &str| variables.iter().find(|(n, _)| *n == name).map(|(_, v)| (*v).to_owned());
        Shard::parse(text, get).map_err(|e| e.to_string())
    }

    fn auto(variables: &[(&str, &str)]) -> Result<Shard, String> {
        shard_of("auto", variables)
    }

    #[test]
    fn every_part_belongs_to_one_shard() {
        for count in [1, 2, 3, 7] {
            for n in 0..20 {
                let owners = (0..count).filter(|&index| Shard { index, count }.owns(n)).count();
                assert_eq!(owners, 1);
            }
            for pieces in [0, 1, 5, 7, 100, u64::MAX] {
                let parts: Vec<_> = (0..count).map(|index| Shard { index, count }.part_of(pieces)).collect();
                assert_eq!((parts[0].start, parts[parts.len() - 1].end), (0, pieces));
                assert!(parts.windows(2).all(|pair| pair[0].end == pair[1].start), "{parts:?}");
                let lengths = || parts.iter().map(|part| part.end - part.start);
                assert!(lengths().max().unwrap() - lengths().min().unwrap() <= 1, "{parts:?}");
            }
        }
    }

    #[test]
    fn schedulers_are_recognised() {
        let shard = |index, count| Ok(Shard { index, count });
        assert_eq!(auto(&[("SLURM_ARRAY_TASK_ID", "3"), ("SLURM_ARRAY_TASK_COUNT", "8")]), shard(3, 8));
        let from_one = [("SLURM_ARRAY_TASK_ID", "8"), ("SLURM_ARRAY_TASK_COUNT", "8"), ("SLURM_ARRAY_TASK_MIN", "1")];
        assert_eq!(auto(&from_one), shard(7, 8));
        let stepped = |id| {
            [
                ("SLURM_ARRAY_TASK_ID", id),
                ("SLURM_ARRAY_TASK_COUNT", "4"),
                ("SLURM_ARRAY_TASK_MIN", "10"),
                ("SLURM_ARRAY_TASK_STEP", "5"),
            ]
        };
        assert_eq!(auto(&stepped("20")), shard(2, 4), "--array=10-25:5");
        let to = |last| [&stepped("20")[..], &[("SLURM_ARRAY_TASK_MAX", last)]].concat();
        assert_eq!(auto(&to("25")), shard(2, 4));
        assert_eq!(auto(&to("27")), shard(2, 4), "--array=10-27:5");
        for list in ["24", "30", "3"] {
            let message = auto(&to(list)).unwrap_err();
            assert!(message.contains("not a range") && message.contains("as in 0-3"), "{list}: {message}");
        }
        for uneven in ["12", "9", "30"] {
            let message = auto(&stepped(uneven)).unwrap_err();
            assert!(message.contains("as in 0-3"), "{uneven}: {message}");
        }
        assert_eq!(auto(&[("AWS_BATCH_JOB_ARRAY_INDEX", "0"), ("AWS_BATCH_JOB_ARRAY_SIZE", "2")]), shard(0, 2));
        assert_eq!(auto(&[("JOB_COMPLETION_INDEX", "1"), ("JOB_COMPLETIONS", "2")]), shard(1, 2));
        assert_eq!(shard_of("auto/7", &[("JOB_COMPLETION_INDEX", "6")]), shard(6, 7));
        assert_eq!(shard_of("auto/7", &[("PARALLEL_SEQ", "1")]), shard(0, 7));
        assert_eq!(shard_of("auto/7", &[("PARALLEL_SEQ", "7")]), shard(6, 7));
        assert_eq!(shard_of("auto/2", &[("AWS_BATCH_JOB_ARRAY_INDEX", "1")]), shard(1, 2));
        assert_eq!(shard_of("auto/8", &from_one), shard(7, 8));
        // parallel within a task of Slurm does not provide the count, but Slurm does.
        assert_eq!(auto(&[&from_one[..], &[("PARALLEL_SEQ", "3")]].concat()), shard(7, 8));
    }

    #[test]
    fn missing_scheduler_variables_are_reported_with_the_fix() {
        assert!(auto(&[]).unwrap_err().contains("SLURM_ARRAY_TASK_ID"));
        assert!(auto(&[]).unwrap_err().contains("write i/n"));
        for alone in ["JOB_COMPLETION_INDEX", "PARALLEL_SEQ"] {
            let message = auto(&[(alone, "1")]).unwrap_err();
            assert!(message.contains("auto/n") && message.contains(alone), "{message}");
        }
        assert!(auto(&[("JOB_COMPLETION_INDEX", "1")]).unwrap_err().contains("JOB_COMPLETION_COUNT"));
        assert!(auto(&[("SLURM_ARRAY_TASK_ID", "x"), ("SLURM_ARRAY_TASK_COUNT", "8")]).unwrap_err().contains("\"x\""));
        let other = shard_of("auto/7", &[("SLURM_ARRAY_TASK_ID", "1"), ("SLURM_ARRAY_TASK_COUNT", "8")]);
        assert!(other.unwrap_err().contains("write auto/8"));
        assert!(shard_of("auto/7", &[("PARALLEL_SEQ", "8")]).unwrap_err().contains("as in 0-6"));
    }

    #[test]
    fn invalid_shards_are_rejected() {
        let parse = |text| Shard::parse(text, |_| None).map_err(|e| e.to_string());
        assert_eq!(parse("1/3"), Ok(Shard { index: 1, count: 3 }));
        for (text, expected) in [
            ("3/3", "the last is 2"),
            ("0/0", "of 0 shards"),
            ("1", "i/n"),
            ("a/b", "i/n"),
            ("-1/2", "i/n"),
            ("auto/", "i/n"),
            ("auto/x", "i/n"),
        ] {
            assert!(parse(text).unwrap_err().contains(expected), "{text}: {:?}", parse(text));
        }
    }
}
