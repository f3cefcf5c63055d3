//! Random programs: each is drawn as an author writes it, and with everything said in the text that Eddy promises
//! without: every index clamped, every variable with its zero, every division guarded. Both must give what a small
//! interpreter gives.
//!
//! `EDDY_RANDOM_PROGRAMS` says how many, `EDDY_RANDOM_SEED` which is the first. A program that fails is printed with
//! its seed, made as small as statements can be left out of it; a single one is printed before it is drawn.

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

/// How long a pixel may take, in statements and expressions.
const STEPS: u32 = 200_000;

const REFUSED: &str = " is refused:";

const NAMES: [&str; 2] = ["A", "B"];

type Texels = Vec<[f32; 4]>;

/// Buffers that feed each other.
#[derive(Clone)]
struct Case {
    passes: Vec<Program>,
}

impl Case {
    fn of(seed: u64) -> Self {
        let count = if seed.is_multiple_of(4) { 2 } else { 1 };
        Self { passes: (0..count).map(|pass| make(seed * 2 + pass)).collect() }
    }

    /// What both channels of a pass read: itself or the first pass, and the last one.
    fn channels(&self) -> [usize; 2] {
        [0, self.passes.len() - 1]
    }

    fn text(&self, form: Form) -> String {
        let texts =
            self.passes.iter().zip(NAMES).map(|(pass, name)| format!("// Buffer {name}\n{}", print(pass, form)));
        texts.collect()
    }

    /// What each buffer holds after each frame.
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

    /// The same, drawn.
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

    /// Where what is drawn differs from what should be; `None` where nothing does.
    fn fault(&self, gpu: &Gpu) -> Option<String> {
        let expected = self.expected().ok()?;
        [Form::Explicit, Form::Plain].into_iter().find_map(|form| match self.drawn(gpu, form) {
            Err(error) => Some(format!("{form:?}{REFUSED}\n{error}")),
            Ok(drawn) => difference(&drawn, &expected).map(|text| format!("{form:?}: {text}")),
        })
    }

    /// Without the statements that the fault does not need. What does not compile stays as it is.
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

/// Walks through a buffer of a frame for all of its pixels: a second opinion that owes nothing to a driver.
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

/// The first texel that differs.
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
fn programs_compute_what_they_say() {
    let Some(gpu) = gpu() else { return };
    let (count, first) = (number("EDDY_RANDOM_PROGRAMS", 300), number("EDDY_RANDOM_SEED", 1));
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
                        // Before it is drawn: a driver may not come back.
                        println!("{}", case.text(Form::Plain));
                    }
                    if case.fault(&gpu).is_some() {
                        let case = case.shrunk(&gpu);
                        let fault = case.fault(&gpu).expect("it stays");
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

/// The control: indices that are clamped elsewhere give another picture, often enough to be found.
#[test]
fn a_wrong_clamp_is_seen() {
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
