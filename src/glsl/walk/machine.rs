//! The machine: runs four neighbouring pixels through a program in lockstep.

use super::{
    inputs::EntryInputs,
    layout::{self, Root, SlotKind},
    number::{Cell, Float},
    observer::{Observer, View},
    state::{ALL, Frame, LANES, Lanes, State, of},
    world::{World, uniform_words},
};
use crate::ir::{Block, Case, FuncId, GlobalId, GlobalKind, Input, Level, Module, Op, Output, Stmt, Value};

/// The reason that a walk ended before the program did.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Stop {
    #[error("the program did not end within {0} steps")]
    Steps(u64),
}

/// Returns whether an op needs neighbouring lanes: derivatives, and textures whose level follows from them.
fn is_of_neighbours(op: &Op) -> bool {
    matches!(op, Op::Derivative { .. } | Op::Sample { level: Level::Auto | Level::Bias(_), .. })
}

/// Lanes that have left a block by a jump out of a loop or switch.
#[derive(Default)]
struct Jumps {
    broke: Lanes,
    continued: Lanes,
}

/// Runs a program.
pub struct Machine<'a, R> {
    state: State<'a, R>,
    /// The variables of the module at the start of a run, for one lane.
    initial: Vec<Cell<R>>,
    inputs: EntryInputs,
    /// Lanes that have finished, with or without drawing.
    ended: Lanes,
    /// Those that were discarded.
    discarded: Lanes,
    outputs: Vec<(Output, [Vec<Cell<R>>; LANES])>,
    steps: u64,
    limit: u64,
    scratch: Vec<Cell<R>>,
    /// Frames of finished calls, by their functions, for reuse.
    spare: Vec<Vec<Frame<R>>>,
}

/// The outputs of the lanes of a quad.
#[derive(Clone, Debug)]
pub struct Drawn<R> {
    /// The cells of each output and lane; empty for lanes that drew nothing.
    pub outputs: Vec<(Output, [Vec<Cell<R>>; LANES])>,
    /// Lanes that a `discard` ended.
    pub discarded: [bool; LANES],
    pub steps: u64,
}

impl<R> Drawn<R> {
    /// Returns the cells of an output in a lane; `None` if the lane drew nothing there.
    pub fn output(&self, output: Output, lane: usize) -> Option<&[Cell<R>]> {
        let (_, cells) = self.outputs.iter().find(|(there, _)| *there == output)?;
        Some(&cells[lane][..]).filter(|cells| !cells.is_empty())
    }
}

impl<'a, R: Float> Machine<'a, R> {
    /// Returns a machine for the lanes of `inputs`: four fragments of a quad, or four vertices. It stops a run after
    /// `limit` statements.
    pub fn new(module: &'a Module, world: &'a dyn World, inputs: EntryInputs, limit: u64) -> Self {
        let mut machine = Self {
            state: State::new(module, world),
            initial: Vec::new(),
            inputs,
            ended: 0,
            discarded: 0,
            outputs: Vec::new(),
            steps: 0,
            limit,
            scratch: Vec::new(),
            spare: module.functions.iter().map(|_| Vec::new()).collect(),
        };
        machine.fill_globals();
        machine
    }

    /// Sets the inputs of the next run.
    pub fn set_inputs(&mut self, inputs: EntryInputs) {
        self.inputs = inputs;
    }

    /// Returns the lane of a pixel in its block.
    pub fn lane_of((x, y): (u32, u32)) -> usize {
        ((x & 1) | (y & 1) << 1) as usize
    }

    /// Sets the initial words of a variable of the module, in every lane.
    pub fn set_global(&mut self, global: GlobalId, words: &[u32]) {
        let start = self.state.globals[global.index()];
        let mut cells = Vec::new();
        let ty = self.state.module[global].ty;
        layout::constant(self.state.module, ty, &mut words.iter().copied().chain(std::iter::repeat(0)), &mut cells);
        self.initial[start..start + cells.len()].copy_from_slice(&cells);
    }

    /// Runs the entry point from its start. `observer` is notified about the lane of one pixel.
    pub fn run<O: Observer<R> + ?Sized>(&mut self, lane: usize, observer: &mut O) -> Result<Drawn<R>, Stop> {
        for memory in &mut self.state.memory {
            memory.clear();
            memory.extend_from_slice(&self.initial);
        }
        (self.ended, self.discarded, self.steps) = (0, 0, 0);
        self.outputs.clear();
        let entry = FuncId::new(self.state.module.functions.len() - 1);
        let mut frame = self.frame(entry);
        for (value, op) in self.state.module[entry].values() {
            if let Op::Input(input) = *op {
                self.input(&mut frame, value, input);
            }
        }
        self.body(&mut frame, ALL, lane, observer)?;
        let discarded = std::array::from_fn(|lane| self.discarded & (1 << lane) != 0);
        Ok(Drawn { outputs: std::mem::take(&mut self.outputs), discarded, steps: self.steps })
    }

    fn fill_globals(&mut self) {
        for global in &self.state.module.globals {
            self.state.globals.push(self.initial.len());
            let mut fill = |mut words: &mut dyn Iterator<Item = u32>| {
                layout::constant(self.state.module, global.ty, &mut words, &mut self.initial);
            };
            match global.kind {
                GlobalKind::Private(None) | GlobalKind::Member { .. } => fill(&mut std::iter::repeat(0)),
                GlobalKind::Private(Some(id)) | GlobalKind::Table(id) => {
                    fill(&mut self.state.module[id].words.iter().copied());
                }
                GlobalKind::Uniform(uniform) => fill(&mut uniform_words(self.state.world, uniform).into_iter()),
                GlobalKind::CustomUniform(slot) => fill(&mut self.state.world.custom_uniform(slot).into_iter()),
                GlobalKind::CubeFace => fill(&mut [self.state.world.cube_face()].into_iter()),
                GlobalKind::TileOrigin => {
                    fill(&mut self.state.world.uniforms().tile_origin[..2].iter().map(|number| *number as u32));
                }
            }
        }
    }

    /// Returns a frame in which nothing is computed yet.
    fn frame(&mut self, function: FuncId) -> Frame<R> {
        let layout = &self.state.layouts[function.index()];
        match self.spare[function.index()].pop() {
            Some(mut frame) => {
                frame.clear(layout);
                frame
            }
            None => Frame::new(function, layout),
        }
    }

    fn input(&self, frame: &mut Frame<R>, value: Value, input: Input) {
        for lane in 0..LANES {
            let out = self.state.register_mut(frame, value, lane);
            match input {
                Input::Position => {
                    for (cell, number) in out.iter_mut().zip(self.inputs.position[lane]) {
                        *cell = Cell::Float(R::with_shadow(number.single.into(), number.double));
                    }
                }
                Input::VertexIndex => out.fill(Cell::Bits(self.inputs.vertices[lane])),
                // Each mesh has a single instance.
                Input::InstanceIndex => out.fill(Cell::Bits(0)),
                Input::FrontFacing => out.fill(self.inputs.is_front.into()),
                Input::Attribute { location, .. } | Input::Varying { location, .. } => {
                    self.inputs.slot(location, lane, out);
                }
            }
        }
    }

    /// Runs a function whose arguments are in its frame.
    fn body<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        lanes: Lanes,
        lane: usize,
        observer: &mut O,
    ) -> Result<(), Stop> {
        let module = self.state.module;
        let function = &module[frame.function];
        let base = self.state.memory[0].len();
        let State { layouts, memory, globals, .. } = &mut self.state;
        let layout = &layouts[frame.function.index()];
        let size = base + layout.memory;
        memory.iter_mut().for_each(|memory| memory.resize(size, Cell::Bits(0)));
        for &(place, root) in &layout.roots {
            let start = match root {
                Root::Var(start) => base + start,
                Root::Global(global) => globals[global.index()],
            };
            frame.places[place as usize] = [start as u32; LANES];
        }
        for &(start, init) in &layout.inits {
            for memory in memory.iter_mut() {
                memory[base + start..][..init.size as usize].copy_from_slice(&layout.constants[init.cells(0)]);
            }
        }
        let has_lane = lanes & (1 << lane) != 0;
        if has_lane {
            observer.enter(&View::new(&self.state, frame, lane));
        }
        self.block(frame, &function.body, lanes, &mut Jumps::default(), lane, observer)?;
        if has_lane {
            observer.leave(&View::new(&self.state, frame, lane));
        }
        self.state.memory.iter_mut().for_each(|memory| memory.truncate(base));
        Ok(())
    }

    /// Runs a block. Returns the lanes that reach its end.
    fn block<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        block: &'a Block,
        mut active: Lanes,
        jumps: &mut Jumps,
        lane: usize,
        observer: &mut O,
    ) -> Result<Lanes, Stop> {
        for stmt in block {
            if active == 0 {
                break;
            }
            self.steps += 1;
            if self.steps > self.limit {
                return Err(Stop::Steps(self.limit));
            }
            let is_seen = active & (1 << lane) != 0;
            match stmt {
                Stmt::Let(value) => {
                    self.compute(frame, *value, active, lane, observer)?;
                    if is_seen && active != ALL && is_of_neighbours(&self.state.module[frame.function][*value]) {
                        observer.diverged(&View::new(&self.state, frame, lane), *value);
                    }
                    active &= !self.ended;
                    if is_seen {
                        observer.value(&View::new(&self.state, frame, lane), *value);
                    }
                }
                Stmt::Store { place, value } => {
                    let State { layouts, memory, .. } = &mut self.state;
                    let slots = &layouts[frame.function.index()].slots;
                    let (to, from) = (slots[place.index()].start as usize, slots[value.index()]);
                    for lane in of(active) {
                        let start = frame.places[to][lane] as usize;
                        let cells = &frame.cells[from.cells(lane)];
                        memory[lane][start..start + cells.len()].copy_from_slice(cells);
                    }
                    if is_seen {
                        observer.store(&View::new(&self.state, frame, lane), *place, *value);
                    }
                }
                Stmt::If { condition, accept, reject } => {
                    if is_seen {
                        observer.branch(&View::new(&self.state, frame, lane), stmt);
                        observer.decide(&View::new(&self.state, frame, lane), *condition);
                    }
                    let accepted = self.lanes_where(frame, *condition, active);
                    let left = self.block(frame, accept, active & accepted, jumps, lane, observer)?;
                    let right = self.block(frame, reject, active & !accepted, jumps, lane, observer)?;
                    active = left | right;
                    if is_seen {
                        observer.branch_end(&View::new(&self.state, frame, lane));
                    }
                }
                Stmt::Loop { body, continuing, break_if } => {
                    if is_seen {
                        observer.loop_start(&View::new(&self.state, frame, lane), stmt);
                    }
                    active = self.iterations(frame, (body, continuing, *break_if), active, lane, observer)?;
                    if is_seen {
                        observer.loop_end(&View::new(&self.state, frame, lane));
                    }
                }
                Stmt::Switch { selector, cases } => {
                    if is_seen {
                        observer.branch(&View::new(&self.state, frame, lane), stmt);
                        observer.decide(&View::new(&self.state, frame, lane), *selector);
                    }
                    let mut inner = Jumps::default();
                    let end = self.cases(frame, *selector, cases, active, &mut inner, lane, observer)?;
                    jumps.continued |= inner.continued;
                    active = end | inner.broke;
                    if is_seen {
                        observer.branch_end(&View::new(&self.state, frame, lane));
                    }
                }
                Stmt::Break => {
                    jumps.broke |= active;
                    active = 0;
                }
                Stmt::Continue => {
                    jumps.continued |= active;
                    active = 0;
                }
                Stmt::Return(value) => {
                    if let Some(value) = *value {
                        let size = frame.result.len() / LANES;
                        let from = self.state.layout(frame).slots[value.index()];
                        for lane in of(active) {
                            frame.result[lane * size..][..size].copy_from_slice(&frame.cells[from.cells(lane)]);
                        }
                    }
                    if is_seen {
                        observer.returned(&View::new(&self.state, frame, lane), *value);
                    }
                    active = 0;
                }
                Stmt::Discard => {
                    self.ended |= active;
                    self.discarded |= active;
                    active = 0;
                }
                Stmt::Output(parts) => {
                    for &(output, value) in parts {
                        if is_seen {
                            observer.output(&View::new(&self.state, frame, lane), output, value);
                        }
                        let mut cells: [Vec<Cell<R>>; LANES] = Default::default();
                        for lane in of(active) {
                            cells[lane] = self.state.value(frame, value, lane).to_vec();
                        }
                        match self.outputs.iter_mut().find(|(there, _)| *there == output) {
                            Some((_, there)) => {
                                of(active).for_each(|lane| there[lane] = std::mem::take(&mut cells[lane]))
                            }
                            None => self.outputs.push((output, cells)),
                        }
                    }
                    self.ended |= active;
                    active = 0;
                }
            }
        }
        Ok(active)
    }

    fn lanes_where(&self, frame: &Frame<R>, condition: Value, active: Lanes) -> Lanes {
        of(active).filter(|&lane| self.state.value(frame, condition, lane)[0].is_true()).map(|lane| 1 << lane).sum()
    }

    fn iterations<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        (body, continuing, break_if): (&'a Block, &'a Block, Option<Value>),
        mut active: Lanes,
        lane: usize,
        observer: &mut O,
    ) -> Result<Lanes, Stop> {
        let mut left = 0;
        while active != 0 {
            self.steps += 1;
            if self.steps > self.limit {
                return Err(Stop::Steps(self.limit));
            }
            if active & (1 << lane) != 0 {
                observer.iteration(&View::new(&self.state, frame, lane));
            }
            let mut jumps = Jumps::default();
            let end = self.block(frame, body, active, &mut jumps, lane, observer)?;
            left |= jumps.broke;
            let mut jumps_after = Jumps::default();
            if (end | jumps.continued) & (1 << lane) != 0 {
                observer.continuing(&View::new(&self.state, frame, lane));
            }
            active = self.block(frame, continuing, end | jumps.continued, &mut jumps_after, lane, observer)?;
            left |= jumps_after.broke;
            if let Some(condition) = break_if {
                if active & (1 << lane) != 0 {
                    observer.decide(&View::new(&self.state, frame, lane), condition);
                }
                let done = self.lanes_where(frame, condition, active);
                left |= done;
                active &= !done;
            }
        }
        Ok(left)
    }

    #[expect(clippy::too_many_arguments, reason = "they are the parts of one statement")]
    fn cases<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        selector: Value,
        cases: &'a [Case],
        active: Lanes,
        jumps: &mut Jumps,
        lane: usize,
        observer: &mut O,
    ) -> Result<Lanes, Stop> {
        let default = cases.iter().position(|case| case.label.is_none());
        let chosen: [Option<usize>; LANES] = std::array::from_fn(|lane| {
            let bits = self.state.value(frame, selector, lane)[0].bits();
            cases.iter().position(|case| case.label == Some(bits)).or(default)
        });
        let mut end: Lanes = of(active).filter(|&lane| chosen[lane].is_none()).map(|lane| 1 << lane).sum();
        let mut falling = 0;
        for (index, case) in cases.iter().enumerate() {
            let entering: Lanes = of(active).filter(|&l| chosen[l] == Some(index)).map(|l| 1 << l).sum();
            let reached = self.block(frame, &case.body, entering | falling, jumps, lane, observer)?;
            falling = if case.falls_through { reached } else { 0 };
            end |= if case.falls_through { 0 } else { reached };
        }
        Ok(end | falling)
    }

    /// Computes a value in the active lanes.
    fn compute<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        value: Value,
        active: Lanes,
        lane: usize,
        observer: &mut O,
    ) -> Result<(), Stop> {
        let module = self.state.module;
        let function = &module[frame.function];
        let op = &function[value];
        if let Op::Call { function, args } = op {
            return self.call(frame, value, (*function, args), active, lane, observer);
        }
        let slot = self.state.layout(frame).slots[value.index()];
        if slot.kind == SlotKind::Place {
            self.state.part_of_place(frame, value, active);
            return Ok(());
        }
        self.state.compute(frame, value, active, &mut self.scratch);
        for lane in of(active) {
            observer.correct(frame.function, value, &mut frame.cells[slot.cells(lane)]);
        }
        Ok(())
    }

    fn call<O: Observer<R> + ?Sized>(
        &mut self,
        frame: &mut Frame<R>,
        value: Value,
        (callee, args): (FuncId, &[Value]),
        active: Lanes,
        lane: usize,
        observer: &mut O,
    ) -> Result<(), Stop> {
        if active & (1 << lane) != 0 {
            observer.calling(&View::new(&self.state, frame, lane), args);
        }
        let mut inner = self.frame(callee);
        let slots = &self.state.layout(frame).slots;
        for &(index, param) in &self.state.layouts[callee.index()].params {
            let arg = slots[args[index as usize].index()];
            match param.kind {
                SlotKind::Place => inner.places[param.start as usize] = frame.places[arg.start as usize],
                _ => {
                    for lane in 0..LANES {
                        inner.cells[param.cells(lane)].copy_from_slice(&frame.cells[arg.cells(lane)]);
                    }
                }
            }
        }
        self.body(&mut inner, active, lane, observer)?;
        let size = inner.result.len() / LANES;
        if size > 0 {
            let out = self.state.layout(frame).slots[value.index()];
            for lane in of(active) {
                frame.cells[out.cells(lane)].copy_from_slice(&inner.result[lane * size..][..size]);
            }
        }
        self.spare[callee.index()].push(inner);
        Ok(())
    }
}
