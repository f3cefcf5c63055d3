//! Runs a case on the device: it is drawn from its first frame and checked every few frames; after a violation it is
//! drawn again to find the first frame of that.

use super::{Case, CheckedProject, cases::Broken, inputs::Inputs, judge, quantity_name, record_name};
use crate::{
    LabError, Number,
    stability_record::{Outcome, Recovery, StabilityRecord, Violation},
};
use eddy_engine::{BuildOptions, DrawFor, Engine, Pixels, Program};
use eddy_gpu::Gpu;
use eddy_playback::assertion::{self, Conditions, Found, Range, Region, Worst};
use eddy_project::PassName;
use std::collections::{BTreeMap, btree_map::Entry};

/// The maximum number of frames in flight.
const FRAMES_IN_FLIGHT: u32 = 8;

/// A recovered project may be livelier than undisturbed by this factor (as a root mean square).
const RECOVERED: f64 = 1.1;

/// A subject that is compiled once, and drawn case by case.
pub struct Driver<'s> {
    subject: &'s CheckedProject,
    engine: Engine,
    state: Vec<PassName>,
    /// The largest root mean square of each check without any disturbance, by size and frames.
    calm: BTreeMap<((u32, u32), u32), Vec<f64>>,
}

/// A case that is being drawn.
struct Run<'d, 's, 'c> {
    driver: &'d mut Driver<'s>,
    case: &'c Case,
    inputs: Inputs,
    frame: u32,
}

impl<'s> Driver<'s> {
    /// Compiles the project. Fails with the author's diagnostics.
    pub fn new(gpu: &Gpu, subject: &'s CheckedProject, size: (u32, u32)) -> Result<Driver<'s>, LabError> {
        let mut wanted: Vec<PassName> = vec![PassName::image()];
        wanted.extend(subject.checks.iter().map(|c| c.quantity.pass.clone()));
        wanted.extend(subject.stateful());
        wanted.sort();
        wanted.dedup();
        let mut engine = Engine::new(gpu.clone(), size.0, size.1)?;
        let options = BuildOptions { requested: wanted, skip: true, ..BuildOptions::default() };
        let built = Program::build(gpu, &subject.project, &subject.media, &options);
        engine.set_program(built.map_err(|e| LabError::build(&subject.name, e))?.program)?;
        Ok(Driver { subject, engine, state: subject.stateful().into_iter().collect(), calm: BTreeMap::new() })
    }

    /// Draws a case and returns its result. Errors of the device, such as for a canvas that is too large, are stored in
    /// the record.
    pub fn measure(&mut self, case: &Case) -> StabilityRecord {
        let conditions = judge::conditions(self.subject, case);
        let excuses = self.subject.excuses(&conditions);
        let mut record = StabilityRecord {
            project: self.subject.name.clone(),
            texts: self.subject.fingerprint(),
            kind: case.kind,
            case: case.name.clone(),
            size: case.size,
            frames: case.frames,
            settings: case.settings(),
            excuses,
            ..StabilityRecord::default()
        };
        if let Err(trouble) = self.fill(case, &conditions, &mut record) {
            record.trouble = Some(trouble.to_string());
            record.outcome = None;
        }
        record
    }

    fn fill(&mut self, case: &Case, conditions: &Conditions, record: &mut StabilityRecord) -> Result<(), LabError> {
        let calm = match case.disturbed {
            Some(_) => self.calm(case)?,
            None => Vec::new(),
        };
        let mut seen = Seen::default();
        let mut run = self.start(case)?;
        while run.frame < case.frames {
            let frame = run.draw(case.is_checked(run.frame))?;
            if !case.is_checked(frame) {
                continue;
            }
            let all = run.look(conditions)?;
            seen.take(frame, &all, case, &calm);
        }
        let subject = self.subject;
        record.outcome = Some(match (seen.left, seen.excused) {
            // The values after the previous frame are known to be inside; the violation started in between.
            (Some(at), _) => Outcome::Left(self.first(case, conditions, at, |l| l.is_left)?),
            (None, Some(at)) => Outcome::LeftAsExpected(self.first(case, conditions, at, |_| true)?),
            (None, None) => Outcome::Held,
        });
        for (check, (low, high)) in subject.checks.iter().zip(&seen.extremes) {
            let entry = record.extremes.entry(record_name(&check.quantity)).or_insert((Number(*low), Number(*high)));
            *entry = (Number(entry.0.0.min(*low)), Number(entry.1.0.max(*high)));
        }
        if let Some((_, end)) = case.disturbed {
            record.recovery = Some(match seen.restless {
                None => Recovery::Frames(0),
                Some(last) if last + 1 >= case.frames => Recovery::NotWithin(case.frames - end),
                Some(_) => Recovery::Frames(seen.calm_since.map_or(0, |f| (f + 1).saturating_sub(end))),
            });
        }
        if let (Some(courant), Some((_, high))) = (&subject.courant, seen.extremes.first()) {
            record.courant = Some(Number(courant.cells(*high, conditions)));
        }
        Ok(())
    }

    /// Returns the first frame after `at.0`, which was within all bounds, in which one is left; `at.1` is known to be
    /// such a frame.
    fn first(
        &mut self,
        case: &Case,
        conditions: &Conditions,
        at: (u32, u32),
        counts: impl Fn(&FrameCheck) -> bool,
    ) -> Result<Violation, LabError> {
        let mut run = self.start(case)?;
        let mut last = None;
        while run.frame <= at.1 {
            let frame = run.draw(run.frame >= at.0)?;
            if frame < at.0 {
                continue;
            }
            let all = run.look(conditions)?;
            let found = all.iter().enumerate().find(|(_, l)| l.offence.is_some() && counts(l));
            if let Some((n, looked)) = found {
                let quantity = &run.driver.subject.checks[n].quantity;
                last = looked.offence.map(|worst| Violation {
                    frame,
                    pass: quantity.pass.key().to_owned(),
                    quantity: quantity_name(quantity),
                    texel: worst.texel,
                    value: Number(worst.value),
                    low: Number(looked.range.low),
                    high: Number(looked.range.high),
                    count: worst.count,
                });
                break;
            }
        }
        last.ok_or_else(|| LabError::NotRepeated { project: self.subject.name.clone(), case: case.name.clone() })
    }

    /// Returns the largest value of each check in the same number of undisturbed frames.
    fn calm(&mut self, case: &Case) -> Result<Vec<f64>, LabError> {
        let key = (case.size, case.frames);
        if let Some(known) = self.calm.get(&key) {
            return Ok(known.clone());
        }
        let twin = Case { disturbed: None, poison: None, resizes: Vec::new(), ..case.clone() };
        let conditions = judge::conditions(self.subject, &twin);
        let mut most = vec![0.0f64; self.subject.checks.len()];
        let mut run = self.start(&twin)?;
        while run.frame < twin.frames {
            let frame = run.draw(twin.is_checked(run.frame))?;
            if twin.is_checked(frame) {
                for (most, looked) in most.iter_mut().zip(run.look(&conditions)?) {
                    *most = most.max(looked.found.rms);
                }
            }
        }
        self.calm.insert(key, most.clone());
        Ok(most)
    }

    fn start<'d, 'c>(&'d mut self, case: &'c Case) -> Result<Run<'d, 's, 'c>, LabError> {
        self.engine.resize(case.size.0, case.size.1)?;
        let mut values = self.subject.project.custom_uniform_values.clone();
        values.extend(case.values.clone());
        self.engine.set_custom_uniforms(&values);
        self.engine.reset();
        Ok(Run { driver: self, case, inputs: Inputs::new(case.hand, case.steps, case.disturbed), frame: 0 })
    }
}

/// A check after a frame.
struct FrameCheck {
    found: Found,
    range: Range,
    /// The value outside of the range, or, if that may be left, of the hard limit.
    offence: Option<Worst>,
    /// The range should have been kept.
    is_left: bool,
}

impl Run<'_, '_, '_> {
    /// Draws the next frame and returns its number. For a frame that is not checked, only the passes that later frames
    /// read are drawn.
    fn draw(&mut self, is_seen: bool) -> Result<u32, LabError> {
        let engine = &mut self.driver.engine;
        let frame = self.frame;
        for (_, (width, height)) in self.case.resizes.iter().filter(|(at, _)| *at == frame) {
            engine.resize(*width, *height)?;
        }
        if let Some((_, broken)) = self.case.poison.filter(|(at, _)| *at == frame) {
            for id in &self.driver.state {
                let size = engine.pass_size(id).unwrap_or((1, 1));
                let check = self.driver.subject.checks.iter().find(|c| c.quantity.pass == *id);
                let place = check.map_or(Region::All, |c| c.quantity.region).middle(size);
                match broken {
                    Broken::NotANumber => engine.poison(id, place)?,
                    Broken::Infinite => engine.make_infinite(id, place)?,
                }
            }
        }
        let inputs = self.inputs.next(engine.size());
        engine.draw_for(&inputs, if is_seen { DrawFor::Frame } else { DrawFor::Advance })?;
        if (frame + 1).is_multiple_of(FRAMES_IN_FLIGHT) {
            engine.gpu().wait()?;
        }
        self.frame += 1;
        Ok(frame)
    }

    /// Runs every check on the newest texels.
    fn look(&mut self, conditions: &Conditions) -> Result<Vec<FrameCheck>, LabError> {
        let engine = &mut self.driver.engine;
        let conditions = Conditions { size: engine.size(), ..conditions.clone() };
        let subject = self.driver.subject;
        let mut read: BTreeMap<(&PassName, usize), Pixels> = BTreeMap::new();
        let mut all = Vec::new();
        for check in &subject.checks {
            let (pass, target) = (&check.quantity.pass, check.quantity.target);
            let pixels = match read.entry((pass, target)) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(place) => place.insert(engine.read_target(pass, target)?),
            };
            let stored = assertion::stored(&subject.project, pass, target);
            let (found, range) = check.find(pixels, stored, &conditions, f64::NAN);
            let is_left = found.worst.is_some_and(|worst| !range.excuses(worst.value));
            all.push(FrameCheck { found, range, offence: found.worst, is_left });
        }
        Ok(all)
    }
}

/// The results of the checked frames of a run.
#[derive(Default)]
struct Seen {
    extremes: Vec<(f64, f64)>,
    /// The last frame within its bounds and the first outside: of the bounds that must be kept, and of those that may
    /// be left.
    left: Option<(u32, u32)>,
    excused: Option<(u32, u32)>,
    before: u32,
    /// The last frame after the disturbance with values that were livelier than without it, or outside of their bounds.
    restless: Option<u32>,
    /// The first checked frame after that.
    calm_since: Option<u32>,
}

impl Seen {
    fn take(&mut self, frame: u32, all: &[FrameCheck], case: &Case, calm: &[f64]) {
        if self.extremes.is_empty() {
            self.extremes = vec![(f64::INFINITY, f64::NEG_INFINITY); all.len()];
        }
        for ((low, high), looked) in self.extremes.iter_mut().zip(all) {
            (*low, *high) = (low.min(looked.found.low), high.max(looked.found.high));
            if looked.found.low.is_nan() {
                (*low, *high) = (f64::NAN, f64::NAN);
            }
        }
        if self.left.is_none() && all.iter().any(|l| l.is_left) {
            self.left = Some((self.before, frame));
        }
        if self.excused.is_none() && all.iter().any(|l| l.offence.is_some()) {
            self.excused = Some((self.before, frame));
        }
        self.before = frame + 1;
        if case.disturbed.is_some_and(|(_, end)| frame >= end) {
            let is_lively = |(looked, calm): (&FrameCheck, &f64)| looked.found.rms > RECOVERED * calm + 1e-6;
            if all.iter().any(|l| l.is_left) || all.iter().zip(calm).any(is_lively) {
                (self.restless, self.calm_since) = (Some(frame), None);
            } else {
                self.calm_since = self.calm_since.or(Some(frame));
            }
        }
    }
}
