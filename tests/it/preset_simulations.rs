//! The hard cases, for every simulation and every state machine among the presets: a violent mouse, long steps, broken
//! numbers, odd sizes, long runs, sliders at their ends, resizes, pauses. Each must stay finite and within its bound,
//! and come back.

use crate::support::{presets::*, *};
use eddy::{
    engine::{BuildOptions, Engine, FrameInputs},
    media::MediaSet,
    project::{CustomUniformType, CustomUniformValue, Project},
};

/// A simulation: the buffer that is its state, the largest number that may ever stand in one of its buffers, and how
/// many frames a broken number may live on for, through buffers that are read a frame late; for a fluid, the greatest
/// speed.
struct Simulation {
    name: &'static str,
    state: &'static str,
    bound: f32,
    memory: i32,
    speed: Option<f32>,
}

// The fluids in one pass are held below 0.4 of the speed of sound, which is 22 where the sliders make it fastest; the
// accurate one is pushed by jets, lids and hands of at most 3, and eddies that meet add up.
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
    // Its memory is signed with the canvas's size, a whole number up to 2^24.
    Simulation { name: "mouse-state", state: "A", bound: 16_777_216.0, memory: 2, speed: None },
];

/// Whether the cases of this module are drawn of a preset.
pub(crate) fn are_drawn_of(preset: &str) -> bool {
    SIMULATIONS.iter().any(|simulation| simulation.name == preset)
}

/// Every buffer and the picture are finite and within the bound.
fn check(simulation: &Simulation, engine: &mut Engine, when: &str) {
    for id in buffers(&preset(simulation.name)) {
        let pixels = engine.read(id).unwrap();
        let worst = pixels
            .texels
            .iter()
            .flatten()
            .fold(0.0f32, |m, v| if v.is_finite() { m.max(v.abs()) } else { f32::NAN.max(1e38) });
        assert!(worst <= simulation.bound, "{}, {when}: {} holds {worst}", simulation.name, id.title());
    }
    let Some(limit) = simulation.speed else { return };
    let state = engine.read(&buffer(simulation.state)).unwrap();
    // Row 0 of the fluids in one pass is the mouse's memory; what is above has a density.
    let one_pass = simulation.name != "fluid-accurate";
    for t in &state.texels[if one_pass { state.width as usize } else { 0 }..] {
        let speed = t[0].hypot(t[1]);
        assert!(speed <= limit, "{}, {when}: a speed of {speed}", simulation.name);
        assert!(!one_pass || (0.5..=3.0).contains(&t[2]), "{}, {when}: a density of {}", simulation.name, t[2]);
    }
}

/// Presses and drags across the whole canvas in single frames, from corner to corner.
fn violent(frame: i32, (w, h): (f32, f32)) -> FrameInputs {
    let corners = [[1.0, 1.0], [w - 1.0, h - 1.0], [w - 1.0, 1.0], [1.0, h - 1.0]];
    held(frame, Some(([1.0, 1.0], corners[frame as usize % 4])))
}

#[test]
fn a_drag_across_the_whole_canvas_in_one_frame_is_survived() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = drawn(&gpu, &preset(s.name), true, (48, 27), 0..5, untouched);
        draw(&mut engine, 5..40, |f| violent(f, (48.0, 27.0)));
        check(s, &mut engine, "under a violent hand");
        draw(&mut engine, 40..100, untouched);
        check(s, &mut engine, "after it");
    }
}

/// A brush is as wide as the canvas is high by a factor: on a large one it presses along more cells, where sound is no
/// faster.
#[test]
fn a_violent_hand_on_a_large_canvas_keeps_the_density_in_the_corners() {
    let Some(gpu) = gpu() else { return };
    let size = (640, 360);
    for (name, state) in [("fluid", "C"), ("fluid-dye", "A"), ("fluid-lit", "A")] {
        let options = BuildOptions { requested: vec![buffer(state)], ..Default::default() };
        let mut engine = engine_with(&gpu, &preset(name), &MediaSet::new(), &options, size);
        let (mut least, mut most) = (f32::MAX, f32::MIN);
        for part in 0..4 {
            draw(&mut engine, 10 * part..10 * part + 10, |f| violent(f, (640.0, 360.0)));
            let pixels = engine.read(&buffer(state)).unwrap();
            for texel in &pixels.texels[pixels.width as usize..] {
                (least, most) = (least.min(texel[2]), most.max(texel[2]));
            }
        }
        println!("{name}: density from {least} to {most}");
        // 1 less or more Mach 0.4, the most that the method moves with, and half as much again where walls reflect it.
        assert!(least > 0.6 && most < 1.6, "{name}: density from {least} to {most}");
        assert!(least < 0.9, "{name} was not pressed: the test sees nothing");
    }
}

#[test]
fn the_fluids_paint_has_no_colour_that_was_not_poured() {
    let Some(gpu) = gpu() else { return };
    // The least and the most of each component of the five pigments.
    let (least, most) = ([0.05, 0.12, 0.10], [0.98, 0.62, 0.62]);
    let is_poured = |colour: [f32; 3]| (0..3).all(|i| colour[i] > least[i] - 0.001 && colour[i] < most[i] + 0.001);
    // Colours of paint that is thick enough to have one, frames apart.
    let colours = |project: &Project| {
        let mut engine = whole(&gpu, project, true, (48, 27));
        let mut seen = Vec::new();
        for part in 0..6 {
            draw(&mut engine, 100 * part..100 * part + 100, untouched);
            let paint = engine.read(&buffer("D")).unwrap();
            // Row 0 is the mouse's memory.
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
    assert!(!colours(&project).into_iter().all(is_poured), "the test sees nothing");
}

#[test]
fn a_broken_number_in_any_buffer_heals() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let names: Vec<String> =
            preset(s.name).passes.iter().filter_map(|p| p.id.buffer_name().map(str::to_owned)).collect();
        let mut engines = Engines::new(&gpu);
        // Of the grids between the finest and the coarsest one says what all do.
        let between = |name: &str| ["_1", "_3", "_4", "_5"].iter().any(|level| name.ends_with(level));
        for (i, name) in names.into_iter().filter(|n| !between(n)).enumerate() {
            // All three in the state, by turns in the others.
            let numbers = if name == s.state { &BROKEN[..] } else { &BROKEN[i % 3..=i % 3] };
            for number in numbers {
                let mut project = preset(s.name);
                // A pass that is off draws nothing that could break.
                project.passes.iter_mut().for_each(|pass| pass.settings.when = None);
                break_texel(&mut project, &name, (0, 0), 4, number);
                let mut engine = engines.whole(&project, true, (32, 20));
                draw(&mut engine, 0..5, drag);
                let broken = engine.read(&buffer(&name)).unwrap();
                assert!(!all_finite(&broken), "{} {name}: {number} did not arrive", s.name);
                draw(&mut engine, 5..5 + s.memory, drag);
                check(s, &mut engine, &format!("{} frames after {number} in {name}", s.memory));
            }
        }
    }
}

/// Draws further frames of a canvas of this size, with a violent hand or none.
fn in_turn(size: (f32, f32)) -> impl FnMut(&mut Engine, i32, bool) {
    let mut frame = 0;
    move |engine, frames, hand| {
        draw(engine, frame..frame + frames, |f| if hand { violent(f, size) } else { untouched(f) });
        frame += frames;
    }
}

#[test]
fn every_slider_may_go_to_its_ends_and_come_back() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let project = preset(s.name);
        let mut engine = whole(&gpu, &project, true, (32, 20));
        let mut run = in_turn((32.0, 20.0));
        run(&mut engine, 3, false);
        for custom_uniform in project.custom_uniforms().list {
            let Some(range) = &custom_uniform.range else { continue };
            let ends = match custom_uniform.ty {
                CustomUniformType::Bool => continue,
                _ => [range.min, range.max],
            };
            for end in ends {
                let mut turned = project.clone();
                turned.turn_custom_uniform(&custom_uniform, CustomUniformValue::new(custom_uniform.ty, &end));
                engine.set_custom_uniforms(&turned.custom_uniform_values);
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

/// What a violent hand has set in motion dies of viscosity and drag, and does not live on by itself.
#[test]
fn after_a_violent_hand_it_is_calm_again() {
    let Some(gpu) = gpu() else { return };
    // With nothing else that moves it; the frames after which less than a hundredth of the energy is left.
    let cases: [(&str, &str, &[&str], i32); 3] = [
        ("fluid", "A", &["nozzles=0"], 300),
        ("fluid-accurate", "velocity", &["jets=0", "viscosity=0.01"], 600),
        ("mip-fluid", "velocity", &["stirring=0"], 500),
    ];
    for (name, state, custom_uniforms, frames) in cases {
        let mut engine = whole(&gpu, &preset_with(name, custom_uniforms), true, (48, 27));
        // Row 0 of the fluid is the mouse's memory.
        let energy = |engine: &mut Engine| {
            let pixels = engine.read(&buffer(state)).unwrap();
            let speeds = pixels.texels[pixels.width as usize..].iter();
            speeds.map(|t| f64::from(t[0]).powi(2) + f64::from(t[1]).powi(2)).sum::<f64>()
        };
        draw(&mut engine, 0..5, untouched);
        draw(&mut engine, 5..40, |f| violent(f, (48.0, 27.0)));
        let begin = energy(&mut engine);
        draw(&mut engine, 40..40 + frames, untouched);
        let left = energy(&mut engine) / begin;
        println!("{name}: {left:.1e} of the energy after {frames} frames");
        assert!(begin > 1e-3 && left < 0.01, "{name}: {left} of the energy is left after {frames} frames");
    }
}

/// Sliders spoil each other: the corners of the box that their ranges are, the two of all least and all most and some
/// between.
#[test]
fn all_sliders_may_go_to_their_ends_at_once_and_come_back() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let project = preset(s.name);
        let mut engine = whole(&gpu, &project, true, (32, 20));
        let mut run = in_turn((32.0, 20.0));
        run(&mut engine, 3, false);
        for corner in [0, u64::MAX, 0x9e37_79b9_7f4a_7c15, 0x6a09_e667_f3bc_c909, 0xb7e1_5162_8aed_2a6b] {
            let mut turned = project.clone();
            for (i, custom_uniform) in project.custom_uniforms().list.iter().enumerate() {
                let Some(range) = &custom_uniform.range else { continue };
                let end = if corner >> i & 1 == 0 { &range.min } else { &range.max };
                turned.turn_custom_uniform(custom_uniform, CustomUniformValue::new(custom_uniform.ty, end));
            }
            engine.set_custom_uniforms(&turned.custom_uniform_values);
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
fn a_hitch_a_pause_and_a_single_step_are_frames_like_others() {
    let Some(gpu) = gpu() else { return };
    for s in &SIMULATIONS {
        let mut engine = drawn(&gpu, &preset(s.name), true, (32, 20), 0..10, drag);
        // A quarter of a second passes at once.
        draw(&mut engine, 10..14, |f| FrameInputs { time_delta_secs: 0.25, ..drag(f) });
        check(s, &mut engine, "after a hitch");
        // Time stands: a frame forced while paused has a time step and no time; one with no step at all.
        let still = |f: i32| FrameInputs { time_secs: 14.0 / 60.0, ..untouched(f) };
        draw(&mut engine, 14..20, still);
        draw(&mut engine, 20..24, |f| FrameInputs { time_delta_secs: 0.0, ..still(f) });
        check(s, &mut engine, "paused");
        // Frames one by one, each looked at, are the frames of a run.
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
fn a_resize_in_mid_run_leaves_no_undefined_texel() {
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
        // Whatever it has been through, it moves again.
        draw(&mut engine, frame..frame + 40, untouched);
        let before = bits(&engine.read_image().unwrap());
        draw(&mut engine, frame + 40..frame + 60, untouched);
        assert!(before != bits(&engine.read_image().unwrap()), "{} does not move", s.name);
    }
}

#[test]
fn thin_wide_and_odd_canvases_are_canvases() {
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
fn long_runs_neither_burst_nor_fade() {
    for s in &SIMULATIONS {
        long_run(s.name, 600);
    }
}

/// A hundred thousand steps of one simulation, each of which takes minutes:
/// `cargo test --test it preset_simulations -- --ignored`.
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

/// At 16x9: finite, within its bound, and moving to the end.
fn long_run(name: &str, steps: i32) {
    let Some(gpu) = gpu() else { return };
    let s = SIMULATIONS.iter().find(|s| s.name == name).unwrap();
    let project = preset(name);
    // How many steps a frame is: the fluid's are a chain, others' a group; those at the bottom of a V-cycle are sweeps.
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
        assert!(now != last, "{name} stands still at frame {frame}");
        last = now;
    }
}
