use super::*;

const NOMINAL: f32 = NOMINAL_DELTA_SECS as f32;

fn after(start: Instant, millis: u64) -> Instant {
    start + Duration::from_millis(millis)
}

#[test]
fn the_first_frame_is_at_zero_and_the_delta_is_measured_after_it() {
    let (mut c, t) = (Clock::default(), Instant::now());
    let f = c.running_frame(after(t, 5000));
    assert_eq!((f.frame, f.time_secs, f.time_delta_secs, f.frame_rate), (0, 0.0, NOMINAL, 60.0));
    let f = c.running_frame(after(t, 5040));
    assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (1, 0.040, 0.040));
    let f = c.running_frame(after(t, 5050));
    assert!((f.time_secs - 0.050).abs() < 1e-12 && (f.time_delta_secs - 0.010).abs() < 1e-6);
}

#[test]
fn a_pause_freezes_time_and_forced_frames_still_count() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.running_frame(t);
    c.running_frame(after(t, 100));
    c.pause();
    for i in 0..3 {
        let f = c.forced_frame();
        assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (2 + i, 0.1, NOMINAL));
    }
    c.play();
    let f = c.running_frame(after(t, 9000));
    assert_eq!((f.frame, f.time_secs, f.time_delta_secs), (5, 0.1, NOMINAL), "no jump, and 1/60 on resume");
    assert!((c.running_frame(after(t, 9020)).time_secs - 0.12).abs() < 1e-12);
}

#[test]
fn time_continues_from_newest_frame_after_focus() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.running_frame(t);
    c.running_frame(after(t, 50));
    c.rebase();
    let f = c.running_frame(after(t, 60_000));
    assert_eq!((f.time_secs, f.time_delta_secs), (0.050, NOMINAL));
}

#[test]
fn reset_zeroes_time_and_keeps_play_state() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.running_frame(t);
    c.running_frame(after(t, 700));
    c.reset();
    let f = c.running_frame(after(t, 800));
    assert_eq!((f.frame, f.time_secs, f.time_delta_secs, f.frame_rate), (0, 0.0, NOMINAL, 60.0));
    c.pause();
    c.reset();
    assert!(!c.is_playing());
}

#[test]
fn frame_rate_is_measured_over_more_than_half_a_second() {
    let (mut c, t) = (Clock::default(), Instant::now());
    let mut rates = Vec::new();
    for i in 0..=15 {
        rates.push(c.running_frame(after(t, i * 50)).frame_rate);
    }
    assert!(rates[..=10].iter().all(|r| *r == 60.0), "500 ms is not more than 500 ms");
    assert!((rates[11] - 20.0).abs() < 1e-4, "11 frames in 550 ms");
    assert!(rates[12..].iter().all(|r| *r == rates[11]), "constant between");
}

#[test]
fn speed_stretches_time_and_survives_a_reset() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.set_speed(0.25);
    c.running_frame(t);
    let f = c.running_frame(after(t, 400));
    assert!((f.time_secs - 0.1).abs() < 1e-12 && (f.time_delta_secs - 0.1).abs() < 1e-6);
    c.set_speed(4.0);
    let f = c.running_frame(after(t, 1000));
    assert_eq!((f.time_secs, f.time_delta_secs), (0.1, NOMINAL), "another speed goes on from the same time");
    assert!((c.running_frame(after(t, 1050)).time_secs - 0.3).abs() < 1e-12);
    c.reset();
    assert_eq!(c.speed(), 4.0);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        c.set_speed(bad);
        assert_eq!(c.speed(), 4.0);
    }
}

#[test]
fn fixed_step_frames_ignore_real_time() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.set_fixed_rate(Some(24.0));
    for (i, millis) in [0, 3, 900, 901, 5000].into_iter().enumerate() {
        let f = c.running_frame(after(t, millis));
        assert_eq!((f.time_secs, f.time_delta_secs), (i as f64 / 24.0, (1.0 / 24.0) as f32));
    }
    c.set_fixed_rate(None);
    let f = c.running_frame(after(t, 6000));
    assert_eq!(f.time_secs, 4.0 / 24.0);
    assert!((c.running_frame(after(t, 6100)).time_secs - 4.0 / 24.0 - 0.1).abs() < 1e-12);
}

#[test]
fn a_jump_lands_on_the_frame_of_a_run_at_a_fixed_step() {
    let (mut c, t) = (Clock::default(), Instant::now());
    c.running_frame(t);
    c.jump(2.0);
    let f = c.running_frame(after(t, 70));
    assert_eq!((f.frame, f.time_secs), (120, 2.0));
    assert!(c.is_playing());
    c.pause();
    c.jump(0.5);
    let f = c.forced_frame();
    assert_eq!((f.frame, f.time_secs), (30, 0.5));
}

#[test]
fn steps_land_on_the_times_of_a_fixed_step_run() {
    let mut c = Clock::default();
    for i in 0..1000 {
        let f = c.step_frame();
        let want = eddy_engine::FrameInputs::at_fixed_step(i, 60.0);
        assert_eq!(
            (f.frame, f.time_secs, f.time_delta_secs, f.frame_rate),
            (want.frame, want.time_secs, want.time_delta_secs, want.frame_rate)
        );
    }
    assert!(!c.is_playing());
}

#[test]
fn the_time_of_a_running_frame_is_known_before_it() {
    let (mut c, t) = (Clock::default(), Instant::now());
    let check = |c: &mut Clock, millis: u64| {
        let known = c.running_time(after(t, millis));
        assert_eq!(c.running_frame(after(t, millis)).time_secs, known);
        (known * 1e9).round() / 1e9
    };
    assert_eq!([0, 40, 90].map(|millis| check(&mut c, millis)), [0.0, 0.04, 0.09]);
    c.set_speed(0.5);
    assert_eq!([100, 120].map(|millis| check(&mut c, millis)), [0.09, 0.1]);
    c.set_fixed_rate(Some(10.0));
    for millis in [121, 122, 123] {
        check(&mut c, millis);
    }
    assert!((c.time_secs() - 0.4).abs() < 1e-12, "three steps");
}
