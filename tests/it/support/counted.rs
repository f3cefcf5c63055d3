//! Counts of the device against the walker, which runs the program with all its counters.

use eddy::{
    engine::{
        Engine,
        counts::{PassCounts, Prices},
    },
    glsl::{
        Link, PassSource,
        count::{self, CountTable},
        ir::Output,
        walk::{EntryInputs, Machine, Observer, View},
    },
    project::{PassName, Project},
};

/// Counts a pass that was drawn.
pub(crate) fn count(engine: &Engine, project: &Project, pass: &PassName) -> PassCounts {
    let program = engine.counting(project, pass).unwrap();
    engine.count(&program, &Prices::default(), &mut || false).unwrap()
}

#[derive(Default)]
struct Counters(Vec<u32>);

impl Observer<f32> for Counters {
    fn output(&mut self, view: &View<'_, '_, f32>, _: Output, value: eddy::glsl::ir::Value) {
        self.0.extend(view.value(value).iter().map(|cell| cell.bits()));
    }
}

/// Returns the table of a pass, and how often its pixels run each block according to the walker.
pub(crate) fn walked(engine: &mut Engine, pass: &PassName, source: &PassSource<'_>) -> (CountTable, Vec<u64>) {
    let (table, program) = count::walkable(source, &Link::default()).unwrap();
    let inputs = engine.inspect(pass).unwrap();
    let world = inputs.of_draw(None);
    let mut runs = vec![0; table.blocks.len()];
    for pixel in (0..inputs.size.0 * inputs.size.1).map(|n| (n % inputs.size.0, n / inputs.size.0)) {
        let mut counters = Counters::default();
        let mut machine = Machine::<f32>::new(&program, &world, EntryInputs::of_pixel(pixel), 10_000_000);
        machine.run(Machine::<f32>::lane_of(pixel), &mut counters).unwrap();
        for (sum, block) in runs.iter_mut().zip(&table.blocks) {
            *sum += u64::try_from(block.runs.of(&counters.0)).unwrap();
        }
    }
    (table, runs)
}
