//! A frame that is drawn in bands or slices equals a frame that is drawn in one piece, also if it is abandoned in
//! between.

use crate::support::*;
use eddy::{
    engine::{BuildOptions, DrawFor, Engine, EngineError, FrameInputs},
    gpu::{Gpu, Slices},
    media,
    project::{PassName, presets},
};
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
    time::Duration,
};

const SIZE: (u32, u32) = (96, 150);

/// Returns slices that are so short that all draws are split if they can be: by this clock each takes a second.
fn short() -> Slices {
    let calls = AtomicU64::new(0);
    let now = move || 1e3 * calls.fetch_add(1, Ordering::Relaxed) as f64;
    Slices { limit: Duration::from_millis(1), now: Arc::new(now) }
}

fn preset_engine(gpu: &Gpu, name: &str) -> Engine {
    let loaded = presets::load(name).unwrap();
    let (media, _) = media::gather(&loaded.project, None);
    let mut engine = engine_with(gpu, &loaded.project, &media, &BuildOptions::default(), SIZE);
    engine.show(PassName::image());
    engine
}

fn inputs(frame: i32) -> FrameInputs {
    FrameInputs { mouse: [20.0 + frame as f32, 70.0, 20.0, 70.0], ..FrameInputs::at_fixed_step(frame, 60.0) }
}

#[test]
fn frames_in_bands_equal_frames_in_one_piece() {
    let Some(gpu) = gpu() else { return };
    // Presets with steps, buffers that are read back, meshes, several targets, and a picture whose pixels depend on
    // their neighbours.
    for name in ["fluid-accurate", "feedback", "particles", "ssao", "gbuffer-edges", "toon-outline", "taa"] {
        let (mut whole, mut banded) = (preset_engine(&gpu, name), preset_engine(&gpu, name));
        for (frame, rows) in [1, 64, 0, u32::MAX, 37].into_iter().enumerate() {
            whole.draw(&inputs(frame as i32)).unwrap();
            assert!(banded.draw_for(&inputs(frame as i32), DrawFor::Bands(&mut || Some(rows))).unwrap().is_whole);
            assert!(whole.picture().unwrap().bytes == banded.picture().unwrap().bytes, "{name}, {rows} rows");
        }
    }
}

#[test]
fn frames_in_slices_equal_frames_in_one_piece() {
    let Some(gpu) = gpu() else { return };
    let sliced = gpu.in_slices(short());
    for name in presets::names() {
        let (mut whole, mut slices) = (preset_engine(&gpu, name), preset_engine(&sliced, name));
        for frame in 0..4 {
            whole.draw(&inputs(frame)).unwrap();
            let drawn = slices.draw_for(&inputs(frame), DrawFor::Frame).unwrap();
            assert!(whole.picture().unwrap().bytes == slices.picture().unwrap().bytes, "{name}, frame {frame}");
            // The times are known from the second frame on.
            let passes = drawn.stats.passes_drawn as u32;
            assert!(frame == 0 || passes == 0 || drawn.submissions > passes, "{name}: {drawn:?}");
        }
        for pass in presets::load(name).unwrap().project.passes.iter().map(|pass| &pass.id) {
            let (Ok(a), Ok(b)) = (whole.read(pass), slices.read(pass)) else { continue };
            assert!(
                a.texels.iter().zip(&b.texels).all(|(a, b)| a.map(f32::to_bits) == b.map(f32::to_bits)),
                "{name}: {}",
                pass.title()
            );
        }
    }
}

#[test]
fn a_frame_in_slices_is_stopped_by_another_thread() {
    let Some(gpu) = gpu() else { return };
    let mut engine = preset_engine(&gpu.in_slices(short()), "fluid-accurate");
    let stop = Arc::new(AtomicBool::new(false));
    engine.stop_by(stop.clone());
    engine.draw(&inputs(0)).unwrap();
    stop.store(true, Ordering::Relaxed);
    assert!(matches!(engine.draw(&inputs(1)), Err(EngineError::Stopped)));
    // The frames after it are complete again.
    stop.store(false, Ordering::Relaxed);
    assert!(engine.draw_for(&inputs(1), DrawFor::Frame).unwrap().is_whole);
}

#[test]
fn an_abandoned_frame_shows_the_previous_picture_and_does_not_change_later_frames() {
    let Some(gpu) = gpu() else { return };
    let bands = SIZE.1.div_ceil(64);
    for name in ["fluid-accurate", "feedback", "brick-breaker"] {
        let (mut whole, mut banded) = (preset_engine(&gpu, name), preset_engine(&gpu, name));
        for frame in 0..12 {
            let before = banded.picture().unwrap().bytes;
            whole.draw(&inputs(frame)).unwrap();
            let drawn = whole.picture().unwrap().bytes;
            // Abandoned after zero, one or two of three bands, or finished.
            let mut remaining = 0..frame as u32 % (bands + 1);
            let mut rows = || remaining.next().map(|_| 64);
            let is_whole = banded.draw_for(&inputs(frame), DrawFor::Bands(&mut rows)).unwrap().is_whole;
            assert_eq!(is_whole, frame as u32 % (bands + 1) == bands, "{name}, frame {frame}");
            if is_whole {
                assert!(banded.picture().unwrap().bytes == drawn, "{name}, frame {frame}");
                continue;
            }
            assert!(banded.picture().unwrap().bytes == before, "{name}, frame {frame}: it is not finished");
            if frame % 2 == 0 {
                assert!(banded.resume(&mut || Some(u32::MAX)).unwrap());
                assert!(banded.picture().unwrap().bytes == drawn, "{name}, frame {frame}, finished");
                assert!(!banded.resume(&mut || Some(u32::MAX)).unwrap(), "it can be resumed only once");
            }
        }
    }
}

#[test]
fn an_unchanged_picture_is_drawn_after_it_was_abandoned() {
    let Some(gpu) = gpu() else { return };
    let constant = project(vec![image(
        "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, .5, 1.); }",
        Default::default(),
    )]);
    let picture = |engine: &mut Engine| engine.read_image().unwrap().texels;
    let mut whole = ran(&gpu, &constant, SIZE, 1);
    let expected = picture(&mut whole);
    let abandoned = || {
        let mut engine = engine(&gpu, &constant, SIZE);
        let mut remaining = 1;
        let mut rows = || (std::mem::replace(&mut remaining, 0) > 0).then_some(64);
        let drawn = engine.draw_for(&FrameInputs::at_fixed_step(0, 60.0), DrawFor::Bands(&mut rows)).unwrap();
        assert!(!drawn.is_whole);
        engine
    };
    let mut next = abandoned();
    assert!(picture(&mut next) != expected, "rows are missing");
    assert_eq!(next.draw(&FrameInputs::at_fixed_step(1, 60.0)).unwrap().passes_drawn, 1);
    assert!(picture(&mut next) == expected);
    assert_eq!(
        next.draw(&FrameInputs::at_fixed_step(2, 60.0)).unwrap().passes_drawn,
        0,
        "a finished picture is not drawn again"
    );
    for change in
        [|engine: &mut Engine| engine.reset(), |engine: &mut Engine| engine.resize(SIZE.0, SIZE.1 - 1).unwrap()]
    {
        let mut changed = abandoned();
        change(&mut changed);
        assert!(!changed.resume(&mut || Some(u32::MAX)).unwrap(), "the abandoned frame was dropped");
        run(&mut changed, 1, 2);
        let mut fresh = engine(&gpu, &constant, changed.size());
        run(&mut fresh, 1, 2);
        assert!(picture(&mut changed) == picture(&mut fresh));
    }
}
