//! The changes for the engine that wait for the next job.

use eddy_engine::{Program, ValueLook};
use eddy_playback::run::Frame;
use eddy_project::{CustomUniform, CustomUniformValues, PassName, Project};

/// A change for the engine.
pub(crate) enum Change {
    /// Start with an engine that has drawn nothing.
    Restart,
    /// Another canvas size.
    Resize((u32, u32)),
    Program(Box<PendingProgram>),
    CustomUniforms(CustomUniformValues),
    /// Show this pass.
    Show(PassName),
    /// The display of the shown pass: as numbers, or as a picture.
    Look(Option<ValueLook>),
    /// Reset every buffer to its state before frame 0.
    Reset,
    /// The frames of a run from that reset on, to seek in.
    Run(Vec<Frame>),
    /// The costs of the passes are wanted without another frame: a job with [`costs_of`](super::Job::costs_of) is due.
    Costs,
}

impl Change {
    /// The position in the order in which the engine applies changes.
    fn rank(&self) -> u8 {
        match self {
            Self::Restart => 0,
            Self::Resize(_) => 1,
            Self::Program(_) => 2,
            Self::CustomUniforms(_) => 3,
            Self::Show(_) => 4,
            Self::Look(_) => 5,
            Self::Reset => 6,
            Self::Run(_) => 7,
            Self::Costs => 8,
        }
    }
}

/// The pending changes, at most one of a kind, in the order in which the engine applies them.
#[derive(Default)]
pub(crate) struct PendingChanges(pub(super) Vec<Change>);

impl PendingChanges {
    /// Adds a change, in place of an older one of its kind.
    pub(crate) fn set(&mut self, change: Change) {
        self.set_if(true, change);
    }

    /// Adds a change, in place of an older one of its kind, which is dropped also if the change is not wanted.
    pub(crate) fn set_if(&mut self, is_wanted: bool, change: Change) {
        self.0.retain(|older| older.rank() != change.rank());
        if is_wanted {
            self.0.insert(self.0.partition_point(|other| other.rank() < change.rank()), change);
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn iter(&self) -> impl Iterator<Item = &Change> {
        self.0.iter()
    }

    /// Returns whether there is a change of the same kind.
    pub(crate) fn has(&self, kind: &Change) -> bool {
        self.iter().any(|change| change.rank() == kind.rank())
    }

    /// Returns whether another program is to draw.
    pub(crate) fn has_other_program(&self) -> bool {
        self.has(&Change::Restart) || self.program().is_some()
    }

    pub(crate) fn program(&self) -> Option<&PendingProgram> {
        self.iter().find_map(|change| if let Change::Program(program) = change { Some(&**program) } else { None })
    }

    /// The coming canvas size.
    pub(crate) fn size(&self) -> Option<(u32, u32)> {
        self.iter().find_map(|change| if let Change::Resize(size) = change { Some(*size) } else { None })
    }

    /// Returns whether applying the changes alters the targets, given the canvas size.
    pub(crate) fn touches_targets(&self, canvas: (u32, u32)) -> bool {
        self.program().is_some() || self.size().is_some_and(|size| size != canvas)
    }
}

/// A program to be submitted to the engine.
pub(crate) struct PendingProgram {
    pub program: Program,
    /// Kept by the session when the program is submitted.
    pub origin: Option<ProgramOrigin>,
}

/// The session's record of a program.
pub(crate) struct ProgramOrigin {
    /// The project that it was built from.
    pub project: Project,
    /// Milliseconds of the compile, if the program is of the newest text, not a fallback.
    pub millis: Option<f64>,
    /// The author's own uniforms.
    pub custom_uniforms: Vec<CustomUniform>,
    /// The passes that are drawn.
    pub drawn: Vec<PassName>,
}

impl PendingProgram {
    pub(crate) fn new(program: Program, project: Project, millis: Option<f64>) -> Self {
        let drawn = program.plan().targets.iter().map(|t| t.id.clone()).collect();
        let origin = ProgramOrigin { project, millis, custom_uniforms: program.custom_uniforms().to_vec(), drawn };
        Self { origin: Some(origin), program }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranks(changes: &PendingChanges) -> Vec<u8> {
        changes.iter().map(Change::rank).collect()
    }

    #[test]
    fn newer_change_of_a_kind_replaces_the_older() {
        let mut changes = PendingChanges::default();
        changes.set(Change::Resize((4, 4)));
        changes.set(Change::Show(PassName::default()));
        changes.set(Change::Resize((8, 2)));
        assert_eq!(changes.size(), Some((8, 2)));
        assert_eq!(ranks(&changes), [1, 4]);
        changes.set_if(false, Change::Resize((8, 2)));
        assert_eq!((changes.size(), ranks(&changes)), (None, vec![4]));
    }

    #[test]
    fn changes_are_applied_in_one_order_however_they_were_made() {
        // Each needs those before it: the values and the shown pass those of the program, the run the reset.
        let all = || {
            [
                Change::Restart,
                Change::Resize((1, 1)),
                Change::CustomUniforms(CustomUniformValues::new()),
                Change::Show(PassName::default()),
                Change::Look(None),
                Change::Reset,
                Change::Run(Vec::new()),
                Change::Costs,
            ]
        };
        for start in 0..all().len() {
            let mut changes = PendingChanges::default();
            let mut made = all();
            made.rotate_left(start);
            made.into_iter().rev().for_each(|change| changes.set(change));
            let mut applied = changes.0.into_iter();
            for expected in all() {
                let change = applied.next().unwrap();
                assert_eq!(std::mem::discriminant(&change), std::mem::discriminant(&expected), "from {start}");
            }
            assert!(applied.next().is_none());
        }
    }
}
