//! What the pixels of a pass execute, counted on the device.

use crate::support::{
    counted::{count, walked},
    *,
};
use eddy::{
    engine::{BuildError, EngineError, FrameInputs},
    glsl::PassSource,
    project::PassName,
};

const SIZE: (u32, u32) = (16, 12);

/// Draws Image, and compares its counts with the walker's.
fn check(code: &str) -> eddy::engine::counts::PassCounts {
    let gpu = gpu().unwrap();
    let project = project(vec![image(code, Default::default())]);
    let mut engine = engine(&gpu, &project, SIZE);
    engine.draw(&FrameInputs::at_fixed_step(3, 60.0)).unwrap();
    let counts = count(&engine, &project, &PassName::image());
    let (table, runs) = walked(&mut engine, &PassName::image(), &PassSource::image(code));
    assert_eq!(counts.table.blocks, table.blocks);
    assert_eq!(counts.runs, runs, "{code}");
    assert_eq!(counts.pixels, u64::from(SIZE.0 * SIZE.1));
    counts
}

#[test]
fn counts_are_the_walkers() {
    if gpu().is_none() {
        return;
    }
    let counts = check(
        "float f(float x) { for (int i = 0; i < 9; i++) { x += 0.5; if (x > 6.0) return x; if (i == int(x)) continue; x *= 1.1; } return x; }
        void mainImage(out vec4 o, in vec2 p) {
            float s = 0.0;
            for (int i = 0; i < int(p.x); i++) { for (int j = 0; j < int(p.y); j++) s += f(p.x - float(j)); if (s > 300.0) break; }
            switch (int(p.y) % 4) { case 0: s += 1.0; break; case 1: s *= 2.0; default: s -= f(p.y); }
            o = vec4(s > 10.0 && p.x > 4.0 ? f(s) : s);
        }",
    );
    assert_eq!(counts.loops.len(), 3);
    assert!(counts.costliest().is_some_and(|(x, y, _)| x > 2 && y > 2), "{:?}", counts.costliest());
    let lines = counts.lines();
    assert!((0.5..=1.0).contains(&lines.iter().map(|line| line.share).sum::<f64>()));
}

#[test]
fn discarded_pixels_are_counted() {
    if gpu().is_none() {
        return;
    }
    let counts = check(
        "void f(float x) { if (x > 4.0) discard; }
        void mainImage(out vec4 o, in vec2 p) { f(p.x); float s = 0.0;
            for (int i = 0; i < int(p.y); i++) { s += 1.0; if (p.x < 2.0 && i > 5) discard; }
            o = vec4(s); }",
    );
    let walked = (0..SIZE.0 * SIZE.1).filter(|n| n % SIZE.0 >= 4 || (n % SIZE.0 < 2 && n / SIZE.0 > 6));
    assert_eq!(counts.discarded, walked.count() as u64);
}

/// A program without branches needs no draw.
#[test]
fn straight_programs_need_no_counters() {
    let Some(gpu) = gpu() else { return };
    let project =
        project(vec![image("void mainImage(out vec4 o, in vec2 p) {\n o = sin(p.xyxy);\n}", Default::default())]);
    let mut engine = engine(&gpu, &project, SIZE);
    engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
    assert_eq!(engine.counting(&project, &PassName::image()).unwrap().draws(), 0);
    let counts = count(&engine, &project, &PassName::image());
    assert_eq!(counts.lines().iter().map(|line| line.runs).max(), Some(counts.pixels));
    assert!(counts.divergence.iter().all(|divergence| (divergence - 1.0).abs() < 1e-5));
}

/// Counting reads what the frame read, and changes nothing.
#[test]
fn counting_a_buffer_with_feedback_changes_no_later_frame() {
    let Some(gpu) = gpu() else { return };
    let code = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0) + 1.0;
        for (float i = 0.0; i < o.x; i++) o.y += sin(i); }";
    let show = "void mainImage(out vec4 o, in vec2 p) { o = texelFetch(iChannel0, ivec2(p), 0); }";
    let project = project(vec![
        pass(buffer("A"), code, [nearest("A"), None, None, None]),
        image(show, [nearest("A"), None, None, None]),
    ]);
    let mut counted = engine(&gpu, &project, SIZE);
    let mut plain = engine(&gpu, &project, SIZE);
    for frame in 0..5 {
        let inputs = FrameInputs::at_fixed_step(frame, 60.0);
        counted.draw(&inputs).unwrap();
        plain.draw(&inputs).unwrap();
        let counts = count(&counted, &project, &buffer("A"));
        assert_eq!(counts.loops[0].iterations, counts.pixels * (frame as u64 + 1), "frame {frame}");
        assert_eq!(counted.read_image().unwrap().texels, plain.read_image().unwrap().texels);
    }
}

#[test]
fn stopped_counting_is_an_error() {
    let Some(gpu) = gpu() else { return };
    let code = "void mainImage(out vec4 o, in vec2 p) { o = vec4(0); if (p.x > 3.0) o = sin(p.xyxy); }";
    let project = project(vec![image(code, Default::default())]);
    let mut engine = engine(&gpu, &project, SIZE);
    engine.draw(&FrameInputs::at_fixed_step(0, 60.0)).unwrap();
    let program = engine.counting(&project, &PassName::image()).unwrap();
    let stopped = engine.count(&program, &Default::default(), &mut || true);
    assert!(matches!(stopped, Err(EngineError::Stopped)));
    let other = engine.counting(&project, &buffer("A"));
    assert!(matches!(other, Err(BuildError::Engine(EngineError::NoSuchPass(_)))));
}
