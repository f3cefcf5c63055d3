//! A number over time in bounded memory: long records keep the minimum and the maximum of each interval of frames, so
//! that no spike is lost.

/// The maximum number of samples that are kept.
pub const MOST: usize = 4096;

/// The value of a number in a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    pub frame: i32,
    pub time_secs: f64,
    pub value: f64,
}

/// A number over time.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// In the order of their frames, none of them empty.
    cells: Vec<Cell>,
    /// A cell covers two to the power of this many frames.
    power: u32,
    /// The number of samples that the cells contain.
    held: usize,
    newest: Option<Sample>,
}

/// The samples that are kept of a cell's frames.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cell {
    /// The first minimum and the first maximum, which may be the same sample.
    least: Option<Sample>,
    largest: Option<Sample>,
    /// The first sample that is NaN or infinite.
    nonfinite: Option<Sample>,
    /// Frames before the cell were drawn and not measured.
    pub is_after_gap: bool,
}

impl Record {
    /// Adds a sample. A sample of a frame that was measured before replaces everything from there on. `is_after_gap`:
    /// frames before it were not measured.
    pub fn push(&mut self, sample: Sample, is_after_gap: bool) {
        if self.newest.is_some_and(|newest| sample.frame <= newest.frame) {
            self.keep_before(sample.frame);
        }
        self.newest = Some(sample);
        let place = sample.frame >> self.power;
        if self.cells.last().is_none_or(|cell| cell.place(self.power) != Some(place)) {
            self.cells.push(Cell { is_after_gap, ..Cell::default() });
        }
        if let Some(cell) = self.cells.last_mut() {
            self.held -= cell.samples().count();
            cell.take(sample);
            self.held += cell.samples().count();
        }
        // Cells of single frames cannot drop samples: the loop runs once more.
        while self.held > MOST {
            self.thin();
        }
    }

    /// Doubles the length of the cells.
    fn thin(&mut self) {
        self.power += 1;
        let mut cells: Vec<Cell> = Vec::with_capacity(self.cells.len() / 2 + 1);
        for cell in std::mem::take(&mut self.cells) {
            match cells.last_mut().filter(|last| last.place(self.power) == cell.place(self.power)) {
                Some(last) => cell.samples().for_each(|sample| last.take(sample)),
                None => cells.push(cell),
            }
        }
        self.cells = cells;
        self.count();
    }

    /// Drops this frame and all later ones.
    pub fn keep_before(&mut self, frame: i32) {
        if self.newest.is_none_or(|newest| newest.frame < frame) {
            return;
        }
        while let Some(cell) = self.cells.pop() {
            let mut kept = Cell { is_after_gap: cell.is_after_gap, ..Cell::default() };
            cell.samples().filter(|sample| sample.frame < frame).for_each(|sample| kept.take(sample));
            if kept.samples().next().is_some() {
                self.cells.push(kept);
                break;
            }
        }
        if self.cells.is_empty() {
            *self = Self::default();
        }
        self.newest = self.samples().last();
        self.count();
    }

    fn count(&mut self) {
        self.held = self.samples().count();
    }

    /// The sample that was added last.
    pub fn newest(&self) -> Option<Sample> {
        self.newest
    }

    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// All samples that are kept, in the order of frames.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = Sample> {
        self.cells.iter().flat_map(Cell::samples)
    }

    /// The minimum and the maximum of the finite samples.
    pub fn extremes(&self) -> Option<(f64, f64)> {
        let both = self.cells.iter().filter_map(|cell| Some((cell.least?.value, cell.largest?.value)));
        both.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}

impl Cell {
    /// Returns at most three samples, in the order of frames.
    pub fn samples(&self) -> impl DoubleEndedIterator<Item = Sample> + use<> {
        let largest = self.largest.filter(|largest| self.least.is_none_or(|least| least.frame != largest.frame));
        let mut all = [self.least, largest, self.nonfinite];
        all.sort_by_key(|sample| sample.map_or(i32::MAX, |sample| sample.frame));
        all.into_iter().flatten()
    }

    fn place(&self, power: u32) -> Option<i32> {
        self.samples().next().map(|sample| sample.frame >> power)
    }

    fn take(&mut self, sample: Sample) {
        if !sample.value.is_finite() {
            self.nonfinite.get_or_insert(sample);
            return;
        }
        if self.least.is_none_or(|least| sample.value < least.value) {
            self.least = Some(sample);
        }
        if self.largest.is_none_or(|largest| sample.value > largest.value) {
            self.largest = Some(sample);
        }
    }
}
