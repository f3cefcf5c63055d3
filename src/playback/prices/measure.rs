//! Measures the programs, and takes their times apart.

use super::{
    benches::{BENCHES, Bench, GROUPS, MASKS},
    fit::fit,
};
use crate::median;
use eddy_engine::{
    BuildError, BuildOptions, Builder, DrawFor, Engine, EngineError, FrameInputs,
    counts::{OpClass, PassCounts, Prices, TextureFilter},
};
use eddy_gpu::Gpu;
use eddy_media::MediaSet;
use eddy_project::{Channel, Input, Origin, Pass, PassName, Project, Sampler, Source, Wrap};
use std::time::Instant;

/// The number of times that each program is drawn and timed.
const ROUNDS: usize = 9;

/// The canvases that are tried, until the device takes at least [`LEAST_MILLIS`].
const SIZES: [(u32, u32); 4] = [(160, 96), (480, 272), (960, 544), (1920, 1088)];
const LEAST_MILLIS: f64 = 1.0;

/// The strength by which a price is drawn towards its usual ratio: enough for those that no program measures.
const TRUST: f64 = 1e-5;

/// Measures the prices of a device. Takes some seconds, most of them for compiling.
pub fn measure(gpu: &Gpu) -> Result<Prices, BuildError> {
    let mut builder = Builder::new(gpu.clone());
    let mut size = SIZES[0];
    for larger in SIZES {
        size = larger;
        let mut all = [Measured::new(&mut builder, gpu, &BENCHES[1], size)?];
        if times(&mut all)?[0] >= LEAST_MILLIS {
            break;
        }
    }
    let all = BENCHES.iter().map(|bench| (bench, size)).chain([(&BENCHES[0], (16, 16))]);
    let all = all.chain(MASKS.iter().chain(&GROUPS).map(|bench| (bench, size)));
    let mut all =
        all.map(|(bench, size)| Measured::new(&mut builder, gpu, bench, size)).collect::<Result<Vec<_>, _>>()?;
    let millis = times(&mut all)?;
    let fitted = BENCHES.len() + 1;
    let ([nothing, taken, not_taken], [none, whole, one]) = match millis[fitted..] {
        [a, b, c, d, e, f] => ([a, b, c], [d, e, f]),
        _ => unreachable!("three programs each"),
    };
    let masked = snapped(ratio(not_taken - nothing, taken - nothing));
    let group = group(64.0 * ratio(one - none, whole - none));
    let usual = Prices { group, masked, ..Prices::default() };
    let counts = all[..fitted].iter().map(|measured| measured.count(&usual)).collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<Vec<f64>> = counts.iter().map(row).collect();
    let nanos: Vec<f64> = millis[..fitted].iter().map(|millis| millis * 1e6).collect();
    // In units of a sum, of which the second program has most.
    let terms = terms(&usual);
    let unit = nanos[1] / rows[1].iter().zip(&terms).map(|(count, price)| count * price).sum::<f64>();
    let terms: Vec<f64> = terms.into_iter().map(|term| (term * unit).max(1e-6)).collect();
    let found = fit(&rows, &nanos, &terms, TRUST);
    let mut prices = Prices { device: gpu.describe(), ..usual };
    prices.ops.copy_from_slice(&found[..OpClass::COUNT]);
    prices.samples.copy_from_slice(&found[OpClass::COUNT..][..TextureFilter::COUNT]);
    prices.ops[OpClass::Sample as usize] = prices.samples[1];
    [prices.pixel, prices.draw_millis] = [found[found.len() - 2], found[found.len() - 1] / 1e6];
    Ok(prices)
}

/// Returns the prices as terms, in the order of [`row`].
fn terms(prices: &Prices) -> Vec<f64> {
    let fixed = [prices.pixel, 1e3];
    prices.ops.iter().chain(&prices.samples).chain(&fixed).copied().collect()
}

/// Returns the lanes that a program spends on each term: classes, filters, pixels and draws.
fn row(counts: &PassCounts) -> Vec<f64> {
    let mut row = vec![0.0; OpClass::COUNT + TextureFilter::COUNT + 2];
    for (block, lanes) in counts.table.blocks.iter().zip(&counts.lanes) {
        for work in &block.work {
            let filter = work.channel.filter(|_| work.class == OpClass::Sample);
            let filter = filter.and_then(|channel| counts.filters.get(usize::from(channel)));
            let term = filter.map_or(work.class as usize, |filter| OpClass::COUNT + filter.index());
            row[term] += lanes * f64::from(work.count);
        }
    }
    row[OpClass::COUNT + TextureFilter::COUNT] = counts.pixels as f64;
    row[OpClass::COUNT + TextureFilter::COUNT + 1] = 1.0;
    row
}

fn ratio(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { (part / whole).clamp(0.0, 1.0) } else { 0.0 }
}

/// A share near 0 or 1 is that: the rest is noise.
fn snapped(share: f64) -> f64 {
    match share {
        ..0.15 => 0.0,
        0.85.. => 1.0,
        _ => share,
    }
}

/// Returns the group with about this number of pixels: quads beside and above each other.
fn group(size: f64) -> (u32, u32) {
    let shapes = [(2, 2), (4, 2), (4, 4), (8, 4), (8, 8)];
    let distance = |(across, up): (u32, u32)| (f64::from(across * up).ln() - size.max(1.0).ln()).abs();
    shapes.into_iter().min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or((8, 4))
}

/// A program on the device.
struct Measured {
    engine: Engine,
    project: Project,
}

impl Measured {
    fn new(builder: &mut Builder, gpu: &Gpu, bench: &Bench, size: (u32, u32)) -> Result<Self, BuildError> {
        let project = project(bench);
        let built = builder.build(&project, &MediaSet::new(), &BuildOptions::default())?;
        let mut engine = Engine::new(gpu.clone(), size.0, size.1)?;
        engine.set_program(built.program)?;
        Ok(Self { engine, project })
    }

    fn time(&mut self) -> Result<f64, EngineError> {
        let inputs = FrameInputs::at_fixed_step(0, 60.0);
        let has_stamps = self.engine.set_timing(true);
        // What has not changed is not drawn again.
        self.engine.reset();
        let times = if has_stamps {
            self.engine.draw_for(&inputs, DrawFor::Frame)?;
            self.engine.gpu().wait()?;
            self.engine.pass_times().unwrap_or_default()
        } else {
            let began = Instant::now();
            let mut now = || began.elapsed().as_secs_f64() * 1e3;
            self.engine.draw_for(&inputs, DrawFor::Timed(&mut now))?.times
        };
        Ok(times.iter().find(|time| time.pass.is_image()).map_or(0.0, |time| time.gpu_millis))
    }

    fn count(&self, prices: &Prices) -> Result<PassCounts, BuildError> {
        let program = self.engine.counting(&self.project, &PassName::image())?;
        Ok(self.engine.count(&program, prices, &mut || false)?)
    }
}

/// Returns the median time of each program in milliseconds: all are drawn in turn.
fn times(all: &mut [Measured]) -> Result<Vec<f64>, EngineError> {
    let mut times = vec![Vec::with_capacity(ROUNDS); all.len()];
    for round in 0..=ROUNDS {
        for (measured, times) in all.iter_mut().zip(&mut times) {
            let time = measured.time()?;
            // The first draw may compile.
            if round > 0 {
                times.push(time);
            }
        }
    }
    Ok(times.into_iter().map(|times| median(times).unwrap_or_default().max(1e-6)).collect())
}

/// Returns the project of a program. What it reads is drawn by a buffer.
fn project(bench: &Bench) -> Project {
    let pass = |id: PassName, text: String| {
        let source = Source { name: id.title(), path: None, text: text.into() };
        Pass::new(id, source)
    };
    let mut image = pass(PassName::image(), bench.text());
    let mut passes = Vec::new();
    if let Some((format, filter)) = bench.channel {
        let text = "void mainImage(out vec4 o, in vec2 p) { o = vec4(fract(p * 0.37), fract(p.yx * 0.71)); }";
        let mut buffer = pass(PassName::buffer("A"), text.into());
        buffer.settings.format = format;
        passes.push(buffer);
        let sampler = Sampler { filter, wrap: Wrap::Repeat, vflip: true };
        let channel = Channel { input: Input::buffer("A"), sampler };
        image.bindings = [Some(channel), None, None, None].into();
    }
    passes.push(image);
    Project::new(bench.name, passes, Origin::Unsaved)
}
