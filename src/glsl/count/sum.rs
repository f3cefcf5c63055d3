//! Sums of counters.

/// A number of runs: a constant and counters, each times a whole number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sum {
    pub constant: i32,
    /// Counters in ascending order, with factors other than 0.
    pub terms: Vec<(u32, i32)>,
}

impl Sum {
    pub(super) fn constant(constant: i32) -> Self {
        Self { constant, terms: Vec::new() }
    }

    pub(super) fn counter(counter: u32) -> Self {
        Self { constant: 0, terms: vec![(counter, 1)] }
    }

    /// Returns whether it is 0 for every pixel.
    pub fn is_zero(&self) -> bool {
        self.constant == 0 && self.terms.is_empty()
    }

    /// Returns its value for the counters of a pixel.
    pub fn of(&self, counters: &[u32]) -> i64 {
        let terms =
            self.terms.iter().map(|&(counter, factor)| i64::from(factor) * i64::from(counters[counter as usize]));
        i64::from(self.constant) + terms.sum::<i64>()
    }

    pub(super) fn add(&mut self, other: &Sum, factor: i32) {
        self.constant += factor * other.constant;
        for &(counter, times) in &other.terms {
            match self.terms.binary_search_by_key(&counter, |(counter, _)| *counter) {
                Ok(at) => {
                    self.terms[at].1 += factor * times;
                    if self.terms[at].1 == 0 {
                        self.terms.remove(at);
                    }
                }
                Err(at) => self.terms.insert(at, (counter, factor * times)),
            }
        }
    }

    pub(super) fn plus(mut self, other: &Sum) -> Self {
        self.add(other, 1);
        self
    }

    pub(super) fn minus(mut self, other: &Sum) -> Self {
        self.add(other, -1);
        self
    }
}
