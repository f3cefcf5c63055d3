//! Damaged files: projects, pictures, sounds, videos and models with flipped bits, removed, duplicated and mixed parts,
//! changed numbers and lengths. Each is opened and checked, its media are read, and some are drawn, as by `eddy check`
//! and `eddy render`: none may panic, nor take more than 2 s or 1 GiB.
//!
//! Every run has the same cases. `EDDY_DAMAGE_CASES=50000` makes it a long one, `EDDY_DAMAGE_FIRST=1234` starts at a
//! case, `EDDY_DAMAGE_DRAW_EVERY=1` draws all of them instead of one in 40; failing cases are saved in a folder that
//! the message names.

mod ceilings;
mod media_seeds;
mod memory;
mod mutate;
mod readers;
mod seeds;
mod streams;
#[path = "../it/support/mod.rs"]
mod support;

use eddy::{
    engine::{self, BuildOptions, Engine, FrameInputs, Program},
    glsl::Driver,
    gpu::Gpu,
    media::{self, MediaSet},
    project,
    video::{FrameSource, Pace},
};
use mutate::Random;
use seeds::{File, Seed};
use std::{
    any::Any,
    collections::BTreeMap,
    fs,
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    sync::atomic::{AtomicUsize, Ordering},
    time::{Duration, Instant},
};
use support::clock::Clock;

#[global_allocator]
static MEMORY: memory::Counting = memory::Counting::new();

static PANICS: AtomicUsize = AtomicUsize::new(0);

/// CPU time of the opening thread; the time of other threads and of ffmpeg counts as waiting.
const MAX_CPU_TIME: Duration = Duration::from_secs(2);
/// Wall-clock time, with a margin for a busy machine.
const MAX_WAITING_TIME: Duration = Duration::from_secs(15);
const MAX_BYTES: usize = 1 << 30;
/// One in this number of cases is drawn: a device takes a hundred times as long as the rest.
const DRAW_EVERY: u64 = 40;

/// The results for the cases of one kind of file.
#[derive(Default)]
struct Tally {
    cases: u64,
    /// The number of projects that were opened, and of those whose pictures and models were all intact.
    opened: u64,
    intact: u64,
    drawn: u64,
    longest: Duration,
    waited: Duration,
    largest: usize,
}

#[test]
fn damaged_files_do_not_panic_and_stay_within_limits() {
    let number = |name: &str| std::env::var(name).ok().map(|n| n.parse::<u64>().expect(name));
    let (first, cases) = (number("EDDY_DAMAGE_FIRST").unwrap_or(0), number("EDDY_DAMAGE_CASES").unwrap_or(400));
    let draw_every = number("EDDY_DAMAGE_DRAW_EVERY").unwrap_or(DRAW_EVERY);
    ceilings::check();
    let gpu = support::gpu();
    let seeds = seeds::all();
    let dir = tempfile::tempdir().unwrap();
    for seed in &seeds {
        let folder = dir.path().join(seed.name);
        seed.files.iter().for_each(|file| write(&folder, file));
        let mut tally = Tally::default();
        open(&folder.join(seed.entry), gpu.as_ref(), &mut tally);
        let all = (tally.opened, tally.intact, tally.drawn);
        assert_eq!(all, (1, 1, u64::from(gpu.is_some())), "{} is intact before it is damaged", seed.name);
    }
    let mut tallies: BTreeMap<&str, Tally> = BTreeMap::new();
    let mut failures = Vec::new();
    let previous_hook = std::panic::take_hook();
    // Decoders work on threads of their own, whose panics are not propagated.
    std::panic::set_hook(Box::new(|_| {
        PANICS.fetch_add(1, Ordering::Relaxed);
    }));
    for case in first..first + cases {
        let seed = &seeds[(case % seeds.len() as u64) as usize];
        let folder = dir.path().join(case.to_string());
        damaged(seed, &seeds, case).iter().for_each(|file| write(&folder, file));
        let gpu = gpu.as_ref().filter(|_| (case / seeds.len() as u64).is_multiple_of(draw_every));
        let tally = tallies.entry(seed.name).or_default();
        let before = MEMORY.start();
        let (start, wall_start) = (Clock::now(), Instant::now());
        let result = catch_unwind(AssertUnwindSafe(|| open(&folder.join(seed.entry), gpu, tally)));
        let (time, bytes) = (start.elapsed(), MEMORY.peak().saturating_sub(before));
        let waited = wall_start.elapsed();
        tally.cases += 1;
        tally.waited = tally.waited.max(waited);
        tally.longest = tally.longest.max(time);
        tally.largest = tally.largest.max(bytes);
        let problem = match result {
            Err(panic) => {
                PANICS.store(0, Ordering::Relaxed);
                Some(format!("panicked: {}", panic_message(&*panic)))
            }
            Ok(()) if PANICS.swap(0, Ordering::Relaxed) > 0 => Some("panicked on another thread".into()),
            Ok(()) if time > MAX_CPU_TIME => Some(format!("took {time:.1?}")),
            Ok(()) if waited > MAX_WAITING_TIME => Some(format!("took {waited:.1?} of wall-clock time")),
            Ok(()) if bytes > MAX_BYTES => Some(format!("took {} MiB", bytes >> 20)),
            Ok(()) => None,
        };
        if let Some(problem) = problem {
            let failure_folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("damage-{case}"));
            let _ = fs::remove_dir_all(&failure_folder);
            damaged(seed, &seeds, case).iter().for_each(|file| write(&failure_folder, file));
            failures.push(format!("case {case} ({}), saved in {}: {problem}", seed.name, failure_folder.display()));
        }
        fs::remove_dir_all(&folder).unwrap();
    }
    std::panic::set_hook(previous_hook);
    println!("  cases  opened  intact   drawn  longest   waited  largest");
    for (name, t) in &tallies {
        let (millis, mebibytes) = (t.longest.as_millis(), t.largest >> 20);
        let waited = t.waited.as_millis();
        let [cases, opened, intact, drawn] = [t.cases, t.opened, t.intact, t.drawn];
        println!("{cases:7} {opened:7} {intact:7} {drawn:7} {millis:5} ms {waited:5} ms {mebibytes:4} MiB  {name}");
    }
    assert!(failures.is_empty(), "{} of {cases}:\n{}", failures.len(), failures.join("\n"));
    // A generator that destroys everything tests only the first lines of the readers.
    let opened: u64 = tallies.values().map(|t| t.opened).sum();
    let intact: u64 = tallies.values().map(|t| t.intact).sum();
    assert!(
        opened * 3 > cases && intact * 20 > cases && intact < opened,
        "{opened} opened and {intact} intact of {cases}"
    );
}

/// Returns the seed's files with one of them damaged.
fn damaged(seed: &Seed, seeds: &[Seed], case: u64) -> Vec<File> {
    let mut random = Random::new(case);
    let mut files = seed.files.clone();
    let targets: Vec<usize> = (0..files.len()).filter(|n| files[*n].is_target).collect();
    let target = targets[random.below(targets.len())];
    let others: Vec<&[u8]> =
        seeds.iter().flat_map(|s| &s.files).filter(|f| f.is_target).map(|f| f.bytes.as_slice()).collect();
    let other = others[random.below(others.len())];
    let bytes = &mut files[target].bytes;
    for _ in 0..1 + random.below(3) {
        mutate::mutate(bytes, other, &mut random);
    }
    // Checksums are corrected, otherwise nothing of a PNG beyond its checksums would be reached.
    if random.below(4) > 0 {
        mutate::fix_png_checksums(bytes);
    }
    files
}

fn write(folder: &Path, file: &File) {
    let path = folder.join(file.name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, &file.bytes).unwrap();
}

/// Does the same as `eddy check`, then as `eddy render`: without a device as far as possible.
fn open(path: &Path, gpu: Option<&Gpu>, tally: &mut Tally) {
    let Ok(loaded) = project::load(path.to_str().unwrap()) else { return };
    let project = &loaded.project;
    let texts = engine::Sources::new(project);
    let _ = texts.check_common();
    for index in 0..project.passes.len() {
        let _ = texts.compile_pass(index, Driver::default());
    }
    let mut meshes = MediaSet::new();
    media::meshes(project, &mut meshes);
    let errors = meshes.mesh_errors(project);
    drop(meshes);
    let (media, warnings) = media::gather(project, None);
    tally.opened += 1;
    tally.intact += u64::from(errors.is_empty() && warnings.is_empty());
    // Frames after the first, which a video decodes when it is loaded.
    let channels = project.passes.iter().flat_map(|pass| pass.bindings.channels());
    for video in channels.filter_map(|channel| media.video(channel.input.media()?)) {
        let _ = video.frame_at(0.2, Pace::Exact);
    }
    let Some(gpu) = gpu else { return };
    let Ok(built) = Program::build(gpu, project, &media, &BuildOptions::default()) else { return };
    let Ok(mut engine) = Engine::new(gpu.clone(), 16, 9) else { return };
    let drawn = engine.set_program(built.program).and_then(|()| engine.draw(&FrameInputs::at_fixed_step(0, 60.0)));
    let drawn = drawn.is_ok() && engine.read_image().is_ok();
    tally.drawn += u64::from(drawn);
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}
