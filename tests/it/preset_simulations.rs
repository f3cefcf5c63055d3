//! Hard cases for every simulation and every state machine among the presets: violent drags, long steps, NaN and
//! infinity, odd sizes, long runs, sliders at their ends, resizes, pauses. Each must stay finite and within its bound,
//! and recover.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs},
    media::MediaSet,
    project::{CustomUniformType, CustomUniformValue, Project},
};

/// A simulation: the buffer of its state, the largest allowed number in any of its buffers, the number of frames for
/// which a NaN or infinity may persist through buffers that are read a frame late, and the largest speed of a fluid.
struct Simulation {
    name: &'static str,
    state: &'static str,
    bound: f32,
    memory: i32,
    speed: Option<f32>,
}

// The fluids in one pass are limited to 0.4 of the speed of sound, which is at most 22 for all sliders; the accurate
// one is driven by jets, lids and drags of at most 3, and eddies that meet add up.
const SIMULATIONS: [Simulation; 10] = [
    Simulation { name: "fluid", state: "A", bound: 4096.0, memory: 2, speed: Some(10.0) },
    Simulation { name: "fluid-dye", state: "A", bound: 4096.0, memory: 2, speed: Some(10.0) },
    Simulation { name: "fluid-lit", state: "A", bound: 4096.0, memory: 2, speed: Some(10.0) },
    Simulation { name: "reaction-diffusion", state: "A", bound: 1e4, memory: 2, speed: None },
    Simulation { name: "self-advection", state: "paint", bound: 1e4, memory: 3, speed: None },
    Simulation { name: "fluid-accurate", state: "velocity", bound: 1e4, memory: 3, speed: Some(8.0) },
    Simulation { name: "mip-fluid", state: "velocity", bound: 1e4, memory: 4, speed: None },
    Simulation { name: "particles", state: "motion", bound: 1e4, memory: 3, speed: None },
    Simulation { name: "brick-breaker", state: "A", bound: 1e5, memory: 2, speed: None },
    // It stores the picture's size, a whole number up to 2^24, to detect a resize.
    Simulation { name: "mouse-state", state: "A", bound: 16_777_216.0, memory: 2, speed: None },
];

/// Returns whether this module tests a preset.
pub(crate) fn tests_preset(preset: &str) -> bool {
    SIMULATIONS.iter().any(|simulation| simulation.name == preset)
}

/// Asserts that every buffer and the picture are finite and within the bound.
fn check(simulation: &Simulation, engine: &mut Engine, when: &str) {
    for id in buffers(&preset(simulation.name)) {
        let pixels = engine.read(id).unwrap();
        let worst = pixels
            .texels
            .iter()
            .flatten()
            .fold(0.0f32, |m, v| if v.is_finite() { m.max(v.abs()) } else { f32::NAN.max(1e38) });
        assert!(worst <= simulation.bound, "{}, {when}: {} contains {worst}", simulation.name, id.title());
    }
    let Some(limit) = simulation.speed else { return };
    let state = engine.read(&buffer(simulation.state)).unwrap();
    // Row 0 of the fluids in one pass stores the mouse; the rows above have a density.
    let one_pass = simulation.name != "fluid-accurate";
    for t in &state.texels[if one_pass { state.width as usize } else { 0 }..] {
        let speed = t[0].hypot(t[1]);
        assert!(speed <= limit, "{}, {when}: a speed of {speed}", simulation.name);
        assert!(!one_pass || (0.5..=3.0).contains(&t[2]), "{}, {when}: a density of {}", simulation.name, t[2]);
    }
}

/// Returns the input of a drag across the whole picture in single frames, from corner to corner.
fn violent(frame: i32, (w, h): (f32, f32)) -> FrameInputs {
    let corners = [[1.0, 1.0], [w - 1.0, h - 1.0], [w - 1.0, 1.0], [1.0, h - 1.0]];
    held(frame, Some(([1.0, 1.0], corners[frame as usize % 4])))
}

#[test]
fn simulations_survive_drags_across_the_whole_picture() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = drawn(&gpu, &preset(s.name), true, (48, 27), 0..5, untouched);
        draw(&mut engine, 5..40, |f| violent(f, (48.0, 27.0)));
        check(s, &mut engine, "during violent drags");
        draw(&mut engine, 40..100, untouched);
        check(s, &mut engine, "after it");
    }
}

/// A brush's width is a fraction of the picture's height: on a large picture it pushes more cells, while sound is no
/// faster.
#[test]
fn violent_drags_on_a_large_picture_keep_the_density_bounded() {
    let Some(gpu) = gpu() else { return };
    let size = (640, 360);
    for (name, state) in [("fluid", "C"), ("fluid-dye", "A"), ("fluid-lit", "A")] {
        let options = BuildOptions { requested: vec![buffer(state)], ..Default::default() };
        let mut engine = engine_with(&gpu, &preset(name), &MediaSet::new(), &options, size);
        let (mut lowest, mut highest) = (f32::MAX, f32::MIN);
        for part in 0..4 {
            draw(&mut engine, 10 * part..10 * part + 10, |f| violent(f, (640.0, 360.0)));
            let pixels = engine.read(&buffer(state)).unwrap();
            for texel in &pixels.texels[pixels.width as usize..] {
                (lowest, highest) = (lowest.min(texel[2]), highest.max(texel[2]));
            }
        }
        println!("{name}: density from {lowest} to {highest}");
        // 1 plus or minus Mach 0.4, the largest speed of the method, and half as much again where walls reflect it.
        assert!(lowest > 0.6 && highest < 1.6, "{name}: density from {lowest} to {highest}");
        assert!(lowest < 0.9, "{name} was not compressed, so the test is blind");
    }
}

#[test]
fn the_fluids_paint_only_has_poured_colours() {
    let Some(gpu) = gpu() else { return };
    // The range of each component over the five pigments.
    let (lowest, highest) = ([0.05, 0.12, 0.10], [0.98, 0.62, 0.62]);
    let is_poured = |colour: [f32; 3]| (0..3).all(|i| colour[i] > lowest[i] - 0.001 && colour[i] < highest[i] + 0.001);
    // Colours of paint that is thick enough to have one, at intervals of frames.
    let colours = |project: &Project| {
        let mut engine = whole(&gpu, project, true, (48, 27));
        let mut seen = Vec::new();
        for part in 0..6 {
            draw(&mut engine, 100 * part..100 * part + 100, untouched);
            let paint = engine.read(&buffer("D")).unwrap();
            // Row 0 stores the mouse.
            let painted = paint.texels[paint.width as usize..].iter().filter(|t| t[3] > 1e-3);
            seen.extend(painted.map(|t| [0, 1, 2].map(|i| t[i] / t[3])));
        }
        seen
    };
    let mut project = preset("fluid");
    let seen = colours(&project);
    assert!(seen.len() > 500, "only {} painted texels were seen", seen.len());
    let strange: Vec<_> = seen.into_iter().filter(|colour| !is_poured(*colour)).collect();
    assert!(strange.is_empty(), "{strange:?}");
    patch(
        &mut project,
        &buffer("D"),
        "clamp(sum.rgb / max(sum.a, NO_PAINT), low, high)",
        "sum.rgb / max(sum.a, NO_PAINT)",
    );
    assert!(!colours(&project).into_iter().all(is_poured), "the test does not detect other colours");
}

#[test]
fn a_nan_or_infinity_leaves_every_buffer() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let names: Vec<String> =
            preset(s.name).passes.iter().filter_map(|p| p.id.buffer_name().map(str::to_owned)).collect();
        let mut engines = Engines::new(&gpu);
        // Intermediate grids behave alike, so only one of them is tested.
        let between = |name: &str| ["_1", "_3", "_4", "_5"].iter().any(|level| name.ends_with(level));
        for (i, name) in names.into_iter().filter(|n| !between(n)).enumerate() {
            // All three numbers in the state, one of them in each other buffer.
            let numbers = if name == s.state { &BROKEN[..] } else { &BROKEN[i % 3..=i % 3] };
            for number in numbers {
                let mut project = preset(s.name);
                // A pass that is not drawn could not write the number.
                project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
                break_texel(&mut project, &name, (0, 0), 4, number);
                let mut engine = engines.whole(&project, true, (32, 20));
                draw(&mut engine, 0..5, drag);
                let broken = engine.read(&buffer(&name)).unwrap();
                assert!(!all_finite(&broken), "{} {name}: {number} was not written", s.name);
                draw(&mut engine, 5..5 + s.memory, drag);
                check(s, &mut engine, &format!("{} frames after {number} in {name}", s.memory));
            }
        }
    }
}

/// Returns a function that draws the next frames of a picture of this size, with or without violent drags.
fn frame_runner(size: (f32, f32)) -> impl FnMut(&mut Engine, i32, bool) {
    let mut frame = 0;
    move |engine, frames, drags| {
        draw(engine, frame..frame + frames, |f| if drags { violent(f, size) } else { untouched(f) });
        frame += frames;
    }
}

#[test]
fn every_slider_can_go_to_its_ends_and_back() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let project = preset(s.name);
        let mut engine = whole(&gpu, &project, true, (32, 20));
        let mut run = frame_runner((32.0, 20.0));
        run(&mut engine, 3, false);
        for custom_uniform in project.custom_uniforms().list {
            let Some(range) = &custom_uniform.range else { continue };
            let ends = match custom_uniform.ty {
                CustomUniformType::Bool => continue,
                _ => [range.min, range.max],
            };
            for end in ends {
                let mut changed = project.clone();
                changed.turn_custom_uniform(&custom_uniform, CustomUniformValue::new(custom_uniform.ty, &end));
                engine.set_custom_uniforms(&changed.custom_uniform_values);
                run(&mut engine, 12, true);
                run(&mut engine, 12, false);
                check(s, &mut engine, &format!("{} at {end:?}", custom_uniform.name));
                engine.set_custom_uniforms(&project.custom_uniform_values);
                run(&mut engine, 6, false);
                check(s, &mut engine, &format!("back from {} at {end:?}", custom_uniform.name));
            }
        }
    }
}

/// Motion from violent drags decays by viscosity and drag, and does not sustain itself.
#[test]
fn motion_from_violent_drags_decays() {
    let Some(gpu) = gpu() else { return };
    // Without other forces; the number of frames after which less than a hundredth of the energy is left.
    let cases: [(&str, &str, &[&str], i32); 3] = [
        ("fluid", "A", &["nozzles=0"], 300),
        ("fluid-accurate", "velocity", &["jets=0", "viscosity=0.01"], 600),
        ("mip-fluid", "velocity", &["stirring=0"], 500),
    ];
    for (name, state, custom_uniforms, frames) in cases {
        let mut engine = whole(&gpu, &preset_with(name, custom_uniforms), true, (48, 27));
        // Row 0 of the fluid stores the mouse.
        let energy = |engine: &mut Engine| {
            let pixels = engine.read(&buffer(state)).unwrap();
            let speeds = pixels.texels[pixels.width as usize..].iter();
            speeds.map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum::<f64>()
        };
        draw(&mut engine, 0..5, untouched);
        draw(&mut engine, 5..40, |f| violent(f, (48.0, 27.0)));
        let initial = energy(&mut engine);
        draw(&mut engine, 40..40 + frames, untouched);
        let left = energy(&mut engine) / initial;
        println!("{name}: {left:.1e} of the energy after {frames} frames");
        assert!(initial > 1e-3 && left < 0.01, "{name}: {left} of the energy is left after {frames} frames");
    }
}

/// Sliders affect each other: the test visits corners of the box of their ranges, all lowest, all highest and some
/// between.
#[test]
fn all_sliders_can_go_to_their_ends_together_and_back() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let project = preset(s.name);
        let mut engine = whole(&gpu, &project, true, (32, 20));
        let mut run = frame_runner((32.0, 20.0));
        run(&mut engine, 3, false);
        for corner in [0, u64::MAX, 0x9e37_79b9_7f4a_7c15, 0x6a09_e667_f3bc_c909, 0xb7e1_5162_8aed_2a6b] {
            let mut changed = project.clone();
            for (i, custom_uniform) in project.custom_uniforms().list.iter().enumerate() {
                let Some(range) = &custom_uniform.range else { continue };
                let end = if corner >> i & 1 == 0 { &range.min } else { &range.max };
                changed.turn_custom_uniform(custom_uniform, CustomUniformValue::new(custom_uniform.ty, end));
            }
            engine.set_custom_uniforms(&changed.custom_uniform_values);
            run(&mut engine, 20, true);
            run(&mut engine, 20, false);
            check(s, &mut engine, &format!("sliders at {corner:x}"));
            engine.set_custom_uniforms(&project.custom_uniform_values);
            run(&mut engine, 10, false);
            check(s, &mut engine, &format!("back from sliders at {corner:x}"));
        }
        let before = bits(&engine.read_image().unwrap());
        run(&mut engine, 20, false);
        assert!(before != bits(&engine.read_image().unwrap()), "{} does not move", s.name);
    }
}

#[test]
fn hitches_pauses_and_single_steps_are_stable() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = drawn(&gpu, &preset(s.name), true, (32, 20), 0..10, drag);
        // A quarter of a second passes at once.
        draw(&mut engine, 10..14, |f| FrameInputs { time_delta_secs: 0.25, ..drag(f) });
        check(s, &mut engine, "after a hitch");
        // Time is stopped: frames forced while paused have a time step but no progress; then frames with a step of 0.
        let still = |f: i32| FrameInputs { time_secs: 14.0 / 60.0, ..untouched(f) };
        draw(&mut engine, 14..20, still);
        draw(&mut engine, 20..24, |f| FrameInputs { time_delta_secs: 0.0, ..still(f) });
        check(s, &mut engine, "paused");
        // Frames drawn one by one and read equal the frames of a run.
        let [mut stepped, mut run] = [(); 2].map(|()| whole(&gpu, &preset(s.name), true, (32, 20)));
        for frame in 0..12 {
            draw(&mut stepped, frame..frame + 1, drag);
            stepped.read(&buffer(s.state)).unwrap();
        }
        draw(&mut run, 0..12, drag);
        let [a, b] = [&mut stepped, &mut run].map(|e| bits(&e.read(&buffer(s.state)).unwrap()));
        assert!(a == b, "{}: single steps differ from a run", s.name);
    }
}

#[test]
fn a_resize_during_a_run_leaves_no_undefined_texel() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = whole(&gpu, &preset(s.name), true, (48, 27));
        let mut frame = 0;
        for (w, h) in [(31, 17), (96, 54), (1, 1), (7, 80), (48, 27)] {
            draw(&mut engine, frame..frame + 8, drag);
            frame += 8;
            engine.resize(w, h).unwrap();
            draw(&mut engine, frame..frame + 1, drag);
            frame += 1;
            check(s, &mut engine, &format!("resized to {w}x{h}"));
        }
        // The simulation still moves.
        draw(&mut engine, frame..frame + 40, untouched);
        let before = bits(&engine.read_image().unwrap());
        draw(&mut engine, frame + 40..frame + 60, untouched);
        assert!(before != bits(&engine.read_image().unwrap()), "{} does not move", s.name);
    }
}

#[test]
fn simulations_survive_thin_wide_and_odd_sizes() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = whole(&gpu, &preset(s.name), true, (48, 27));
        for (w, h) in [(1, 1), (2, 1), (1, 2), (3, 3), (17, 31), (1, 4096), (4096, 1), (320, 10), (9, 160), (161, 89)] {
            engine.resize(w, h).unwrap();
            engine.reset();
            draw(&mut engine, 0..3, untouched);
            draw(&mut engine, 3..9, |f| violent(f, (w as f32, h as f32)));
            check(s, &mut engine, &format!("{w}x{h}"));
        }
    }
}

#[test]
fn long_runs_stay_bounded_and_keep_moving() {
    for s in &SIMULATIONS {
        long_run(s.name, 600);
    }
}

/// Tests of a hundred thousand steps of one simulation, which take minutes each: `cargo test --test it
/// preset_simulations -- --ignored`.
macro_rules! hundred_thousand_steps {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        #[ignore = "minutes"]
        fn $test() {
            long_run($name, 100_000);
        })*
    };
}

hundred_thousand_steps! {
    a_hundred_thousand_steps_of_fluid: "fluid",
    a_hundred_thousand_steps_of_fluid_dye: "fluid-dye",
    a_hundred_thousand_steps_of_fluid_lit: "fluid-lit",
    a_hundred_thousand_steps_of_reaction_diffusion: "reaction-diffusion",
    a_hundred_thousand_steps_of_self_advection: "self-advection",
    a_hundred_thousand_steps_of_fluid_accurate: "fluid-accurate",
    a_hundred_thousand_steps_of_mip_fluid: "mip-fluid",
    a_hundred_thousand_steps_of_particles: "particles",
    a_hundred_thousand_steps_of_brick_breaker: "brick-breaker",
    a_hundred_thousand_steps_of_mouse_state: "mouse-state",
}

/// Runs a simulation at 16x9 and asserts that it is finite, within its bound, and moving to the end.
fn long_run(name: &str, steps: i32) {
    let Some(gpu) = gpu() else { return };
    let s = SIMULATIONS.iter().find(|s| s.name == name).unwrap();
    let project = preset(name);
    // The number of steps per frame: the fluid's are a chain, others' a group; those at the bottom of a V-cycle are
    // sweeps.
    let of_groups = project.groups.iter().filter(|g| g.name != "bottom").map(|g| g.steps as i32).max();
    let frames = steps / if name == "fluid" { 3 } else { of_groups.unwrap_or(1) };
    let mut engine = whole(&gpu, &project, true, (16, 9));
    let (mut frame, mut last) = (0, Vec::new());
    while frame < frames {
        let to = (frame + 500).min(frames);
        draw(&mut engine, frame..to, untouched);
        frame = to;
        check(s, &mut engine, &format!("frame {frame}"));
        let now = bits(&engine.read(&buffer(s.state)).unwrap());
        assert!(now != last, "{name} does not move at frame {frame}");
        last = now;
    }
}
