//! Says which part of the work is this machine's, where several share it.

use super::LabError;

/// Part `index` of `count`, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    pub index: u64,
    pub count: u64,
}

/// Says where a scheduler's array job says which of its tasks this is, and how many there are: the index, the count,
/// and (for Slurm, whose arrays may begin anywhere) the smallest index.
const SCHEDULERS: [(&str, &str, Option<&str>); 4] = [
    ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", Some("SLURM_ARRAY_TASK_MIN")),
    ("AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE", None),
    // An indexed Job of Kubernetes says no count; its manifest has to hand `completions` in.
    ("JOB_COMPLETION_INDEX", "JOB_COMPLETION_COUNT", None),
    ("JOB_COMPLETION_INDEX", "JOB_COMPLETIONS", None),
];

impl Shard {
    /// All of the work.
    pub const WHOLE: Shard = Shard { index: 0, count: 1 };

    /// Reads `i/n`, counted from 0, or `auto`, which asks `variable` for what a scheduler says.
    pub fn parse(text: &str, variable: impl Fn(&str) -> Option<String>) -> Result<Shard, LabError> {
        if text == "auto" {
            return Self::of_scheduler(variable);
        }
        let form = || LabError::Shard(format!("{text}: a shard is written i/n, from 0/n, or auto"));
        let (index, count) = text.split_once('/').ok_or_else(form)?;
        let number = |t: &str| t.trim().parse::<u64>().map_err(|_| form());
        Self::new(number(index)?, number(count)?)
    }

    fn new(index: u64, count: u64) -> Result<Shard, LabError> {
        if index >= count {
            return Err(LabError::Shard(format!(
                "{index}/{count}: of {count} shards the last is {}",
                count.max(1) - 1
            )));
        }
        Ok(Shard { index, count })
    }

    fn of_scheduler(variable: impl Fn(&str) -> Option<String>) -> Result<Shard, LabError> {
        let number = |name: &str| match variable(name) {
            None => Ok(None),
            Some(text) => match text.trim().parse::<u64>() {
                Ok(n) => Ok(Some(n)),
                Err(_) => Err(LabError::Shard(format!("auto: {name} is {text:?}, not a number"))),
            },
        };
        for (index, count, first) in SCHEDULERS {
            let (Some(index), Some(count)) = (number(index)?, number(count)?) else { continue };
            let first = first.map(number).transpose()?.flatten().unwrap_or(0);
            return Self::new(index.saturating_sub(first), count);
        }
        let names: Vec<String> = SCHEDULERS.iter().map(|(index, count, _)| format!("{index} and {count}")).collect();
        Err(LabError::Shard(format!("auto: no scheduler says which task this is; looked for {}", names.join(", "))))
    }

    /// Returns whether the work's `n`th part is this shard's.
    pub fn owns(&self, n: usize) -> bool {
        n as u64 % self.count == self.index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn auto(variables: &[(&str, &str)]) -> Result<Shard, String> {
        let get = |name: &str| variables.iter().find(|(n, _)| *n == name).map(|(_, v)| (*v).to_owned());
        Shard::parse("auto", get).map_err(|e| e.to_string())
    }

    #[test]
    fn every_part_belongs_to_one_shard() {
        for count in [1, 2, 3, 7] {
            for n in 0..20 {
                let owners = (0..count).filter(|&index| Shard { index, count }.owns(n)).count();
                assert_eq!(owners, 1);
            }
        }
    }

    #[test]
    fn schedulers_are_understood() {
        let shard = |index, count| Ok(Shard { index, count });
        assert_eq!(auto(&[("SLURM_ARRAY_TASK_ID", "3"), ("SLURM_ARRAY_TASK_COUNT", "8")]), shard(3, 8));
        let from_one = [("SLURM_ARRAY_TASK_ID", "8"), ("SLURM_ARRAY_TASK_COUNT", "8"), ("SLURM_ARRAY_TASK_MIN", "1")];
        assert_eq!(auto(&from_one), shard(7, 8));
        assert_eq!(auto(&[("AWS_BATCH_JOB_ARRAY_INDEX", "0"), ("AWS_BATCH_JOB_ARRAY_SIZE", "2")]), shard(0, 2));
        assert_eq!(auto(&[("JOB_COMPLETION_INDEX", "1"), ("JOB_COMPLETIONS", "2")]), shard(1, 2));
        assert!(auto(&[]).unwrap_err().contains("SLURM_ARRAY_TASK_ID"));
        assert!(auto(&[("JOB_COMPLETION_INDEX", "1")]).unwrap_err().contains("JOB_COMPLETION_COUNT"));
        assert!(auto(&[("SLURM_ARRAY_TASK_ID", "x"), ("SLURM_ARRAY_TASK_COUNT", "8")]).unwrap_err().contains("\"x\""));
    }

    #[test]
    fn a_shard_that_cannot_be_is_refused() {
        let parse = |text| Shard::parse(text, |_| None).map_err(|e| e.to_string());
        assert_eq!(parse("1/3"), Ok(Shard { index: 1, count: 3 }));
        for (text, expected) in
            [("3/3", "the last is 2"), ("0/0", "of 0 shards"), ("1", "i/n"), ("a/b", "i/n"), ("-1/2", "i/n")]
        {
            assert!(parse(text).unwrap_err().contains(expected), "{text}: {:?}", parse(text));
        }
    }
}
