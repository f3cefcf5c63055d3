//! Random programs: each is drawn as an author writes it, and with everything that Eddy guarantees written out: every
//! index clamped, every variable initialised to zero, every division guarded. Both must return the results of a small
//! interpreter.
//!
//! `EDDY_RANDOM_PROGRAMS` is the number of programs, `EDDY_RANDOM_SEED` the first seed. A failing program is printed
//! with its seed, without the statements that the failure does not need; a single program is printed before it is
//! drawn.

mod counts;
mod random;

use crate::support::{env::number, *};
use eddy::{
    debugger::trace::{Extent, Tracer},
    diag::render_all,
    engine::{BuildError, BuildOptions, Engine, FrameInputs, PassInputs, Program as Built, Sources},
    gpu::Gpu,
    project::Project,
};
use random::{
    Program,
    interpret::{self, Inputs, TooLong},
    make::make,
    print::{Form, print},
    shrink::shrink,
};
use std::sync::{
    Mutex,
    atomic::{AtomicU64, Ordering},
};

const WIDTH: usize = 6;
const HEIGHT: usize = 4;
const FRAMES: i32 = 3;

/// The limit of evaluated statements and expressions per pixel.
const STEPS: u32 = 200_000;

const REFUSED: &str = " is refused:";

const NAMES: [&str; 2] = ["A", "B"];

type Texels = Vec<[f32; 4]>;

/// Buffers that read each other.
#[derive(Clone)]
struct Case {
    passes: Vec<Program>,
}

impl Case {
    fn of(seed: u64) -> Self {
        let count = if seed.is_multiple_of(4) { 2 } else { 1 };
        Self { passes: (0..count).map(|pass| make(seed * 2 + pass)).collect() }
    }

    /// Returns the passes that the two channels read: the first and the last.
    fn channels(&self) -> [usize; 2] {
        [0, self.passes.len() - 1]
    }

    fn text(&self, form: Form) -> String {
        let texts =
            self.passes.iter().zip(NAMES).map(|(pass, name)| format!("// Buffer {name}\n{}", print(pass, form)));
        texts.collect()
    }

    /// Returns the texels of each buffer after each frame.
    fn expected(&self) -> Result<Vec<Texels>, TooLong> {
        let mut buffers = vec![vec![[0.0; 4]; WIDTH * HEIGHT]; self.passes.len()];
        let mut all = Vec::new();
        for frame in 0..FRAMES {
            for (i, pass) in self.passes.iter().enumerate() {
                let mut texels = Vec::with_capacity(WIDTH * HEIGHT);
                for at in 0..WIDTH * HEIGHT {
                    let given = [(at % WIDTH) as i32, (at / WIDTH) as i32, frame];
                    let channels = self.channels().map(|channel| (WIDTH, &buffers[channel][..]));
                    texels.push(interpret::run(pass, &Inputs { given, channels }, &mut STEPS.clone())?);
                }
                buffers[i] = texels;
            }
            all.extend(buffers.iter().cloned());
        }
        Ok(all)
    }

    /// Draws the buffers and returns the same texels.
    fn drawn(&self, gpu: &Gpu, form: Form) -> Result<Vec<Texels>, String> {
        let channels = self.channels().map(|channel| nearest(NAMES[channel]));
        let passes = self.passes.iter().zip(NAMES).map(|(program, name)| {
            pass(buffer(name), &print(program, form), [channels[0].clone(), channels[1].clone(), None, None])
        });
        let mut passes: Vec<_> = passes.collect();
        passes.push(image("void mainImage(out vec4 o, in vec2 p) { o = vec4(0); }", Default::default()));
        let wanted: Vec<_> = NAMES[..self.passes.len()].iter().map(|name| buffer(name)).collect();
        let options = BuildOptions { requested: wanted.clone(), ..Default::default() };
        let project = project(passes);
        let built = match Built::build(gpu, &project, &Default::default(), &options) {
            Ok(built) => built,
            Err(BuildError::Diagnostics { diagnostics, sources }) => return Err(render_all(&diagnostics, &sources)),
            Err(error) => return Err(error.to_string()),
        };
        let mut engine = Engine::new(gpu.clone(), WIDTH as u32, HEIGHT as u32).map_err(|e| e.to_string())?;
        engine.set_program(built.program).map_err(|e| e.to_string())?;
        let mut all = Vec::new();
        for frame in 0..FRAMES {
            let inputs = FrameInputs::at_fixed_step(frame, 60.0);
            engine.draw(&inputs).map_err(|e| e.to_string())?;
            for (index, name) in wanted.iter().enumerate() {
                let texels = engine.read(name).map_err(|e| e.to_string())?.texels;
                if frame + 1 == FRAMES {
                    let read = engine.inspect(name).map_err(|e| e.to_string())?;
                    walk(&project, index, &read, &texels)?;
                }
                all.push(texels);
            }
        }
        Ok(all)
    }

    /// Returns the first difference from the expected texels; `None` if all are equal.
    fn fault(&self, gpu: &Gpu) -> Option<String> {
        let expected = self.expected().ok()?;
        [Form::Explicit, Form::Plain].into_iter().find_map(|form| match self.drawn(gpu, form) {
            Err(error) => Some(format!("{form:?}{REFUSED}\n{error}")),
            Ok(drawn) => difference(&drawn, &expected).map(|text| format!("{form:?}: {text}")),
        })
    }

    /// Removes the statements that the fault does not need. A case that does not compile is returned unchanged.
    fn shrunk(&self, gpu: &Gpu) -> Case {
        let fails = |case: &Case| case.fault(gpu).is_some_and(|fault| !fault.contains(REFUSED));
        let mut best = self.clone();
        if !fails(self) {
            return best;
        }
        for i in 0..self.passes.len() {
            let rest = best.clone();
            best.passes[i] = shrink(&rest.passes[i], 300, |candidate| {
                let mut case = rest.clone();
                case.passes[i] = candidate.clone();
                fails(&case)
            });
        }
        best
    }
}

/// Compares every pixel of a buffer with the walker: a second implementation that does not depend on a driver.
fn walk(project: &Project, index: usize, read: &PassInputs, drawn: &Texels) -> Result<(), String> {
    let extent = Extent { steps: 0, ..Extent::default() };
    let tracer = Tracer::new(&Sources::new(project), index, read, extent).map_err(|e| e.to_string())?;
    for (at, texel) in drawn.iter().enumerate() {
        let pixel = ((at % WIDTH) as u32, (at / WIDTH) as u32);
        let walked = tracer.trace(pixel).map_err(|e| e.to_string())?.value;
        if walked.as_ref() != Some(texel) {
            return Err(format!("walked, buffer {}, pixel {pixel:?}: {walked:?}, drawn {texel:?}", NAMES[index]));
        }
    }
    Ok(())
}

/// Returns a description of the first texel that differs.
fn difference(drawn: &[Texels], expected: &[Texels]) -> Option<String> {
    assert_eq!(drawn.len(), expected.len());
    let buffers = drawn.len() / FRAMES as usize;
    drawn.iter().zip(expected).enumerate().find_map(|(i, (drawn, expected))| {
        assert_eq!(drawn.len(), expected.len());
        let at = drawn.iter().zip(expected).position(|(a, b)| a != b)?;
        Some(format!(
            "frame {}, buffer {}, pixel {}, {}: {:?}, not {:?}",
            i / buffers,
            NAMES[i % buffers],
            at % WIDTH,
            at / WIDTH,
            drawn[at],
            expected[at]
        ))
    })
}

#[test]
fn programs_match_the_interpreter() {
    let Some(gpu) = gpu() else { return };
    let (count, first) = (number("EDDY_RANDOM_PROGRAMS", 200), number("EDDY_RANDOM_SEED", 1));
    let (next, faults) = (AtomicU64::new(first), Mutex::new(Vec::new()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from).min(8);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= first + count || faults.lock().unwrap().len() >= 5 {
                        return;
                    }
                    let case = Case::of(seed);
                    if count == 1 {
                        // Before it is drawn, as a driver may hang.
                        println!("{}", case.text(Form::Plain));
                    }
                    if case.fault(&gpu).is_some() {
                        let case = case.shrunk(&gpu);
                        let fault = case.fault(&gpu).expect("the fault is still there");
                        let text = case.text(Form::Plain);
                        faults.lock().unwrap().push(format!("seed {seed}: {fault}\n{text}"));
                    }
                }
            });
        }
    });
    let faults = faults.into_inner().unwrap();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The control: a different clamp of indices changes enough pictures to be found.
#[test]
fn a_wrong_clamp_is_detected() {
    let Some(gpu) = gpu() else { return };
    let seeds = 1..=24;
    let seen = seeds.clone().filter(|&seed| {
        let case = Case::of(seed);
        let (expected, drawn) = (case.expected().unwrap(), case.drawn(&gpu, Form::Wrong).unwrap());
        difference(&drawn, &expected).is_some()
    });
    let seen = seen.count();
    assert!(seen >= 6, "{seen} of {} programs", seeds.count());
}
