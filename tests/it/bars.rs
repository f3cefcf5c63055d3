//! Limits of waiting times. The measured times are meaningful only on a quiet machine and in a release build:
//! `cargo test --release --test it bars -- --ignored --nocapture --test-threads 1`. `benches/walk.rs` and
//! `benches/step_back.rs` print more.
//!
//! A further requirement is that a replay of 1,000 recorded frames is equal byte for byte:
//! `EDDY_REPLAY_FRAMES=1000 cargo test --test window recorded_input`.

use crate::support::{clock::Clock, *};
use eddy::{
    debugger::trace::{self, Extent},
    engine::{BuildOptions, FrameInputs, Sources},
    glsl::Probe,
    gpu::GpuOptions,
    project::{self, PassName},
    session::{CanvasCommand, FileCommand, Session, TransportCommand},
};
use std::{
    sync::Arc,
    time::{Duration, Instant},
};

fn millis_since(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}

/// Tracing a pixel of a ray marcher of about 500 lines, recording each step, takes less than 50 ms.
#[test]
#[ignore = "times are meaningful only on a quiet machine"]
fn a_ray_marcher_pixel_is_traced_in_50_milliseconds() {
    let Some(gpu) = gpu() else { return };
    let project = project::load(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/marcher.glsl")).unwrap().project;
    let lines = project.passes[0].source.text.lines().count();
    assert!(lines >= 500, "{lines} lines");
    let mut engine = ran(&gpu, &project, (64, 36), 1);
    let mut read = inspect(&mut engine, &FrameInputs::at_fixed_step(1, 60.0), &PassName::image());
    // The pixels of a larger picture, which is not drawn here.
    (read.size, read.uniforms.resolution) = ((640, 360), [640.0, 360.0, 1.0]);
    let sources = Sources::new(&project);
    let mut times: Vec<f64> = [(320, 180), (200, 120), (440, 240), (100, 300), (560, 60)]
        .into_iter()
        .map(|pixel| {
            // The work runs on one thread, so other load on the machine matters little.
            let start = Clock::now();
            let trace = trace::trace(&sources, 0, &read, pixel, Extent::default()).unwrap();
            let millis = start.elapsed().as_secs_f64() * 1e3;
            println!("{pixel:?}: {} statements in {millis:.1} ms", trace.statements);
            millis
        })
        .collect();
    times.sort_by(f64::total_cmp);
    assert!(times[2] < 50.0, "median {:.1} ms of {times:?}", times[2]);
}

/// Stepping back 300 frames in `fluid` takes less than a second.
#[test]
#[ignore = "times are meaningful only on a quiet machine"]
fn stepping_back_300_frames_takes_less_than_a_second() {
    let Some(gpu) = gpu_with(&GpuOptions::default()) else { return };
    let mut session = Session::new(gpu, Arc::new(|| ())).unwrap();
    session.apply(CanvasCommand::SetFixedSize(Some((480, 270))));
    session.apply(FileCommand::Open("fluid".into()));
    session.apply(TransportCommand::Pause);
    while session.compile_state().compiling || session.compile_state().last.is_none() {
        session.tick(Instant::now());
        std::thread::sleep(Duration::from_millis(2));
    }
    let steps = |session: &mut Session, frames: usize| {
        for _ in 0..frames {
            session.apply(TransportCommand::Step);
            session.tick(Instant::now());
        }
    };
    steps(&mut session, 700);
    let mut times: Vec<f64> = (0..5)
        .map(|n| {
            // The distance from a snapshot varies.
            let back = 300 - 7 * n;
            let expected_frame = session.transport().frame - back as i32;
            let start = Instant::now();
            session.apply(TransportCommand::StepBack(back));
            session.tick(Instant::now());
            let millis = millis_since(start);
            assert_eq!(session.transport().frame, expected_frame, "{:?}", session.notices());
            steps(&mut session, back);
            millis
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("300 frames back: {times:.0?} ms");
    assert!(times[4] < 1000.0, "{times:.0?} ms");
}

/// A frame with a probe takes at most a tenth longer than one without: of Image, whose picture is not shown meanwhile,
/// and of buffers that the rest of the frame needs. The medians are of frames that are drawn in alternation.
#[test]
#[ignore = "times are meaningful only on a quiet machine"]
fn a_probe_costs_at_most_a_tenth_of_a_frame() {
    let Some(gpu) = gpu() else { return };
    let marcher = project::load(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/marcher.glsl")).unwrap().project;
    let text = marcher.passes[0].source.text.clone();
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let buffered =
        project(vec![pass(buffer("A"), &text, Default::default()), image(show, [nearest("A"), None, None, None])]);
    let fluid = project::presets::load("fluid").unwrap().project;
    let buffer_of = |name: &str| buffer(name);
    let mut too_slow = Vec::new();
    for (what, project, pass, size, expression) in [
        ("marcher, Image, along", &marcher, PassName::image(), (320, 180), "along = normalize(uv.x"),
        ("marcher, Image, normal", &marcher, PassName::image(), (320, 180), "n = normal_at"),
        ("marcher, Image, in the loop", &marcher, PassName::image(), (320, 180), "hit = map(from"),
        ("marcher, Image, in the map", &marcher, PassName::image(), (320, 180), "q = abs(p) - size"),
        ("marcher, buffer, along", &buffered, buffer_of("A"), (320, 180), "along = normalize(uv.x"),
        ("marcher, buffer, normal", &buffered, buffer_of("A"), (320, 180), "n = normal_at"),
        ("marcher, buffer, in the loop", &buffered, buffer_of("A"), (320, 180), "hit = map(from"),
        ("marcher, buffer, in the map", &buffered, buffer_of("A"), (320, 180), "q = abs(p) - size"),
    ] {
        too_slow.extend(probe_ratio(&gpu, what, project, pass, size, expression).filter(|(_, ratio)| *ratio > 1.1));
    }
    for pass in &fluid.passes {
        let Some((at, _)) = pass.source.text.match_indices(" = ").last() else { continue };
        let expression = &pass.source.text[at + 1..];
        let what = format!("fluid, {}", pass.id.title());
        too_slow.extend(
            probe_ratio(&gpu, &what, &fluid, pass.id.clone(), (480, 270), expression).filter(|(_, ratio)| *ratio > 1.1),
        );
    }
    assert!(too_slow.is_empty(), "{too_slow:?}");
}

/// Returns the time of a frame with a probe divided by that of one without; `None` if the place has no value.
fn probe_ratio(
    gpu: &eddy::gpu::Gpu,
    what: &str,
    project: &project::Project,
    pass: PassName,
    size: (u32, u32),
    expression: &str,
) -> Option<(String, f64)> {
    let index = project.passes.iter().position(|p| p.id == pass)?;
    let at = project.passes[index].source.text.find(expression)? as u32;
    let probe = Probe { source: project::Project::pass_id(index), at, visit: 0 };
    Sources::new(project).probed(index, &probe)?;
    let (media, _) = eddy::media::gather(project, None);
    // A session draws all passes that the picture needs, and of Image the probed value instead.
    let own = if pass.is_image() { vec![PassName::image()] } else { Vec::new() };
    let buffers = || project.passes.iter().map(|p| p.id.clone()).filter(|id| id.is_picture() && !id.is_image());
    let plain: Vec<PassName> = own.into_iter().chain(buffers()).collect();
    let wanted = [BuildOptions::probed()].into_iter().chain(buffers()).collect();
    let with = |options: &BuildOptions| engine_with(gpu, project, &media, options, size);
    let (mut plain, mut probed) = (
        with(&BuildOptions { requested: plain, ..BuildOptions::default() }),
        with(&BuildOptions { requested: wanted, probe: Some((pass, probe)), ..BuildOptions::default() }),
    );
    let (mut plain_times, mut probed_times) = (Vec::new(), Vec::new());
    for frame in 0..33 {
        for (engine, times) in [(&mut plain, &mut plain_times), (&mut probed, &mut probed_times)] {
            let start = Instant::now();
            engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
            gpu.wait().unwrap();
            times.push(millis_since(start));
        }
    }
    let median = |times: &[f64]| {
        // The first frames are left out: a driver compiles in them.
        let mut times = times[2..].to_vec();
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (plain, probed) = (median(&plain_times), median(&probed_times));
    println!("{what}: {plain:.2} ms, probed {probed:.2} ms, x {:.3}", probed / plain);
    Some((what.to_owned(), probed / plain))
}
