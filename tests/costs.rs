//! Costs of each pass: bytes by the plan, milliseconds by both clocks, and the output of the command line.
//!
//! A separate program, because one test compares milliseconds of passes: other tests would draw at the same time.

#[path = "it/support/mod.rs"]
mod support;

use eddy::{
    engine::{BuildOptions, CostClock, DrawFor, Drawn, FrameInputs, PassRole, ReadTiming},
    gpu::GpuOptions,
    media::MediaSet,
    project::{PassSize, Project, TexelFormat},
};
use std::process::Command;
use support::{buffer, engine_with, gpu_with, image, nearest, pass, project};

const SIZE: (u32, u32) = (64, 32);

/// A cheap pass that reads itself, an expensive one of half the size, Image that reads both, and a pass that no other
/// reads.
fn chain() -> Project {
    let own = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + vec4(0.25); }";
    let expensive = "void mainImage(out vec4 o, in vec2 p) { float s = p.x + texelFetch(iChannel0, ivec2(p), 0).x; \
                for (int i = 0; i < 4000; ++i) s = sin(s + float(i)); o = vec4(s); }";
    let both = "void mainImage(out vec4 o, in vec2 p) { ivec2 q = ivec2(p); \
                o = texelFetch(iChannel0, q, 0) + texelFetch(iChannel1, q / 2, 0) + texelFetch(iChannel2, q, 0); }";
    let mut project = project(vec![
        pass(buffer("A"), own, [nearest("A"), None, None, None]),
        pass(buffer("B"), expensive, [nearest("A"), None, None, None]),
        pass(buffer("C"), own, [nearest("C"), None, None, None]),
        // Buffer A twice: read once.
        image(both, [nearest("A"), nearest("B"), nearest("A"), None]),
    ]);
    project.passes[1].settings.size = PassSize::Scale(0.5);
    project.passes[1].settings.format = TexelFormat::R16f;
    project
}

#[test]
fn bytes_match_the_plan_and_an_unread_pass_is_reported() {
    let Some(gpu) = gpu_with(&GpuOptions::default()) else { return };
    let project = chain();
    let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &BuildOptions::default(), SIZE);
    engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
    let costs = engine.pass_costs(&project);
    let texels = u64::from(SIZE.0 * SIZE.1);
    let seen: Vec<_> = costs.iter().map(|c| (c.pass.key(), c.role, c.held_bytes, c.moved_bytes, c.texels)).collect();
    let drawn = PassRole::Drawn { is_cached: false };
    assert_eq!(
        seen,
        [
            // Two textures of 16 bytes per texel; one is read, one written.
            ("buffer_a", drawn, 2 * 16 * texels, 2 * 16 * texels, texels),
            // A quarter of the texels, 2 bytes each, and all of Buffer A.
            ("buffer_b", drawn, 2 * texels / 4, 2 * texels / 4 + 16 * texels, texels / 4),
            ("image", drawn, 16 * texels, 16 * texels + 16 * texels + 2 * texels / 4, texels),
            ("buffer_c", PassRole::Unread, 0, 0, 0),
        ]
    );
    // The reads of each pass, also of the one that is not drawn.
    let reads =
        |i: usize| costs[i].reads.iter().map(|r| (r.channel, r.pass.key(), r.when, r.is_used)).collect::<Vec<_>>();
    assert_eq!(reads(0), [(0, "buffer_a", ReadTiming::LastFrame, true)]);
    assert_eq!(reads(1), [(0, "buffer_a", ReadTiming::ThisFrame, true)]);
    assert_eq!(reads(3), [(0, "buffer_c", ReadTiming::LastFrame, false)]);
    let plan = engine.program().unwrap().plan();
    assert_eq!(plan.traffic(SIZE).bytes, costs.iter().map(|c| c.moved_bytes).sum::<u64>());
    assert_eq!(plan.target_bytes(SIZE), costs.iter().map(|c| c.held_bytes).sum::<u64>());
}

#[test]
fn a_skipped_pass_is_reported_as_cached() {
    let Some(gpu) = gpu_with(&GpuOptions::default()) else { return };
    let still = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p, 0.0, 1.0); }";
    let project = project(vec![image(still, Default::default())]);
    let mut engine = engine_with(&gpu, &project, &MediaSet::new(), &BuildOptions::default(), SIZE);
    let mut role = |frame| {
        engine.draw(&FrameInputs::at_fixed_step(frame, 60.0)).unwrap();
        engine.pass_costs(&project)[0].role
    };
    assert_eq!([role(0), role(1)], [PassRole::Drawn { is_cached: false }, PassRole::Drawn { is_cached: true }]);
}

#[test]
fn without_timestamps_passes_are_waited_for_and_draw_the_same_picture() {
    let Some(gpu) = gpu_with(&GpuOptions { use_timestamps: false, ..Default::default() }) else { return };
    let project = chain();
    let open = || engine_with(&gpu, &project, &MediaSet::new(), &BuildOptions::default(), SIZE);
    let (mut waited, mut plain) = (open(), open());
    assert_eq!(waited.cost_clock(), CostClock::Waited);
    for frame in 0..6 {
        let inputs = FrameInputs::at_fixed_step(frame, 60.0);
        plain.draw(&inputs).unwrap();
        // A clock whose intervals grow: each pass has an interval of its own, in the order in which they are drawn.
        let mut reading = 0.0;
        let mut now = || {
            reading += 1.0;
            reading * reading
        };
        let Drawn { stats, times, .. } = waited.draw_for(&inputs, DrawFor::Timed(&mut now)).unwrap();
        assert_eq!((stats.passes_drawn, times.len()), (3, 3));
        let millis: Vec<f64> = times.iter().map(|time| time.gpu_millis).collect();
        assert!(millis[0] > 0.0 && millis[0] < millis[1] && millis[1] < millis[2], "{millis:?}");
        assert!(millis.iter().sum::<f64>() <= reading * reading, "{millis:?}");
    }
    let read = |engine: &mut eddy::engine::Engine, id| engine.read(&id).unwrap().texels;
    for id in [buffer("A"), buffer("B"), eddy::project::PassName::image()] {
        assert!(read(&mut waited, id.clone()) == read(&mut plain, id.clone()), "{id:?}");
    }
}

#[test]
fn bench_prints_bytes_next_to_milliseconds() {
    if gpu_with(&GpuOptions::default()).is_none() {
        return;
    }
    let bench = |json: &[&str]| {
        let eddy = env!("CARGO_BIN_EXE_eddy");
        let output =
            Command::new(eddy).args(["bench", "feedback", "--size", "64x32", "--frames", "3"]).args(json).output();
        let output = output.unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let line: serde_json::Value = serde_json::from_str(bench(&["--json"]).trim()).unwrap();
    // Members of earlier versions are still there.
    for member in ["cpu_us_per_pass", "worst_ms", "target_bytes", "target_bytes_saved", "passes_rested", "frame_ms"] {
        assert!(line[member].is_number(), "{member}: {line}");
    }
    let passes = line["passes"].as_array().unwrap();
    assert!(passes.iter().all(|p| p["pass"].is_string() && p["gpu_ms"].is_number() && p["ms"] == p["gpu_ms"]));
    let buffer = passes.iter().find(|p| p["pass"] == "buffer_a").unwrap();
    assert_eq!(buffer["held_bytes"], 2 * 16 * 64 * 32, "{buffer}");
    assert_eq!(buffer["moved_bytes"], 2 * 16 * 64 * 32, "{buffer}");
    let sum: u64 = passes.iter().map(|p| p["moved_bytes"].as_u64().unwrap()).sum();
    assert_eq!((line["moved_bytes"].as_u64(), line["clock"].as_str()), (Some(sum), Some("timestamps")));
    let words = bench(&[]);
    assert!(words.contains("all passes") && words.contains("MiB memory") && words.contains("MiB traffic"), "{words}");
}
