use super::*;
use crate::{Sound, Source, Track};
use std::time::Duration;

const RATE: f64 = 44_100.0;

/// Returns a sound whose sample `n` is `n` thousandths of a per mille on the left, and its negative on the right.
fn ramp(frames: usize) -> Arc<Sound> {
    let frames = (0..frames).map(|n| [n as f32 * 1e-6, n as f32 * -1e-6]).collect();
    Arc::new(Sound { frames, truncated: false })
}

fn sine(hertz: f64, seconds: f64) -> Arc<Sound> {
    let frame = |n: usize| [(0.5 * (std::f64::consts::TAU * hertz * n as f64 / RATE).sin()) as f32; 2];
    Arc::new(Sound { frames: (0..(seconds * RATE) as usize).map(frame).collect(), truncated: false })
}

fn track(value: impl Fn(usize) -> i16, frames: usize, block: usize, made: &[usize]) -> Arc<Track> {
    let track = Track::new(frames, block);
    for index in made {
        track.write(*index, (0..block).map(|n| [value(index * block + n); 2]).collect());
    }
    Arc::new(track)
}

fn scene(sources: &[Source]) -> Arc<Scene> {
    Arc::new(Scene { sources: sources.to_vec() })
}

/// A device that plays buffers of 10 ms, with the clock of the picture.
struct Bench {
    mixer: Mixer,
    remote: Remote,
    start: Instant,
    rate: f64,
    /// The rate of the device's clock relative to real time.
    drift: f64,
    frames: u64,
    desired: OutputState,
}

impl Bench {
    fn new(rate: u32, scene: Arc<Scene>) -> Self {
        let (mixer, remote) = mixer(rate);
        let start = Instant::now();
        let desired = OutputState { scene, line: None, gain: 1.0 };
        let mut bench = Self { mixer, remote, start, rate: f64::from(rate), drift: 0.0, frames: 0, desired };
        bench.order(|_| {});
        bench
    }

    fn now(&self) -> Instant {
        self.start + Duration::from_secs_f64(self.frames as f64 / self.rate / (1.0 + self.drift))
    }

    fn order(&mut self, change: impl FnOnce(&mut OutputState)) {
        change(&mut self.desired);
        assert!(self.remote.send(&self.desired));
    }

    fn line(&mut self, secs: f64, speed: f64) {
        let at = self.now();
        self.order(|desired| desired.line = Some(Timeline { at, secs, speed }));
    }

    /// Returns the left channel of this number of seconds.
    fn play(&mut self, secs: f64) -> Vec<f32> {
        let buffer = (self.rate / 100.0) as usize;
        let mut left = Vec::new();
        while left.len() < (secs * self.rate).round() as usize {
            let mut out = vec![9.0; 2 * buffer];
            let now = self.now();
            self.mixer.fill(&mut out, 2, now);
            self.frames += buffer as u64;
            left.extend(out.chunks(2).map(|frame| frame[0]));
            self.remote.free();
        }
        left
    }
}

fn largest_step(samples: &[f32]) -> f32 {
    samples.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max)
}

#[test]
fn a_sound_at_its_own_rate_plays_unchanged_samples_at_the_pictures_time() {
    let mut bench = Bench::new(44_100, scene(&[Source::Loop(ramp(400_000))]));
    bench.line(2.0, 1.0);
    let left = bench.play(1.0);
    // After the fade, each sample is exactly the one of its time.
    for n in (0..44_100).filter(|n| *n > 1000) {
        assert_eq!(left[n], (88_200 + n) as f32 * 1e-6, "sample {n}");
    }
    assert!(left[0] < 0.001 && left[100] < left[300], "it fades in");
}

#[test]
fn a_loop_wraps_to_its_start() {
    let mut bench = Bench::new(44_100, scene(&[Source::Loop(ramp(10_000))]));
    bench.line(1.0, 1.0);
    let left = bench.play(0.5);
    assert!((1000..22_050).all(|n| left[n] == ((44_100 + n) % 10_000) as f32 * 1e-6));
}

#[test]
fn other_rates_and_speeds_read_the_right_positions() {
    for (rate, speed) in [(48_000, 1.0), (96_000, 1.0), (22_050, 1.0), (44_100, 0.25), (48_000, 4.0), (48_000, 0.5)] {
        let mut bench = Bench::new(rate, scene(&[Source::Loop(ramp(900_000))]));
        bench.line(2.0, speed);
        let left = bench.play(0.5);
        for n in (rate as usize / 10..left.len()).step_by(97) {
            let secs = 2.0 + speed * n as f64 / f64::from(rate);
            let error = f64::from(left[n]) * 1e6 - secs * RATE;
            // The tolerance is a thousandth of what is read: the kernel's gain.
            assert!(error.abs() < 1.0 + 2e-3 * secs * RATE, "{rate} at {speed}: {error} samples off");
        }
    }
}

#[test]
fn a_pause_fades_out_and_playback_resumes_at_its_time() {
    let mut bench = Bench::new(48_000, scene(&[Source::Loop(sine(220.0, 10.0))]));
    bench.line(0.0, 1.0);
    let playing = bench.play(0.3);
    // The steps of a sine are at most 2 pi 220 / 48000 of its height; a fade of 5 ms adds 1/240 of it.
    let most = 0.5 * (std::f32::consts::TAU * 220.0 / 48_000.0) + 0.5 / 240.0 + 1e-3;
    bench.order(|desired| desired.line = None);
    let paused = bench.play(0.1);
    assert!(paused[300..].iter().all(|sample| *sample == 0.0), "silent after 5 ms");
    bench.line(7.0, 1.0);
    let after = bench.play(0.3);
    let all = [playing, paused, after].concat();
    assert!(largest_step(&all) < most, "{} of {most}", largest_step(&all));
    assert!(all.last().is_some_and(|last| last.abs() <= 0.5));
}

#[test]
fn a_seek_a_reset_and_a_scrub_jump_without_a_click() {
    let mut bench = Bench::new(44_100, scene(&[Source::Loop(ramp(400_000))]));
    bench.line(0.0, 1.0);
    let mut all = bench.play(0.2);
    for secs in [5.0, 0.0, 3.0, 3.1, 2.9, 8.0] {
        bench.line(secs, 1.0);
        // Faster than a fade: no deck is free, and the last order wins.
        all.extend(bench.play(0.01));
    }
    let wanted = bench.desired.line.unwrap();
    all.extend(bench.play(0.1));
    // From one end of the ramp to the other within a fade of 220 samples.
    assert!(largest_step(&all) < 0.36 / 200.0, "{}", largest_step(&all));
    let (last, at) = (all[all.len() - 1], bench.now() - Duration::from_secs_f64(1.0 / RATE));
    assert!((f64::from(last) * 1e6 - wanted.position_at(at)).abs() < 1.5, "{last}");
    assert_eq!(bench.remote.state.jumps(), 6);
}

#[test]
fn an_edit_cross_fades_at_the_same_position() {
    let old = track(|n| (n % 20_000) as i16, 400_000, 4096, &(0..98).collect::<Vec<_>>());
    let new = track(|n| -((n % 20_000) as i16), 400_000, 4096, &(0..98).collect::<Vec<_>>());
    let mut bench = Bench::new(44_100, scene(&[Source::Track(old)]));
    bench.line(0.1, 1.0);
    let before = bench.play(0.1);
    bench.order(|desired| desired.scene = scene(&[Source::Track(new)]));
    let after = bench.play(0.1);
    let at = |n: usize| ((4410.0 + n as f64) as usize % 20_000) as f32 / 32_768.0;
    assert_eq!(before[3000], at(3000));
    assert_eq!(after[4000], -at(before.len() + 4000), "at the same place");
    // No gap and no click: from one to the other, 2 x .27, within 220 samples.
    let all = [&before[1000..], &after[..]].concat();
    assert!(largest_step(&all) < 0.60 / 200.0, "{}", largest_step(&all));
    assert_eq!(bench.remote.state.jumps(), 0);
    // The same sound again makes no audible difference.
    let same = match &bench.desired.scene.sources[0] {
        Source::Track(track) => track.clone(),
        Source::Loop(_) => unreachable!(),
    };
    bench.order(|desired| desired.scene = scene(&[Source::Track(same)]));
    let first = before.len() + after.len();
    assert!(bench.play(0.1).iter().enumerate().all(|(n, sample)| (sample + at(first + n)).abs() < 1e-6));
}

#[test]
fn a_missing_block_is_silence_without_a_click_until_it_is_written() {
    let made = track(|_| 16_384, 40_960, 4096, &[0, 1, 3, 4, 5, 6]);
    let mut bench = Bench::new(48_000, scene(&[Source::Track(made.clone())]));
    bench.line(0.0, 1.0);
    let left = bench.play(0.45);
    let at = |block: f64| (block * 4096.0 * 48_000.0 / RATE) as usize;
    assert!((left[at(1.5)] - 0.5).abs() < 1e-3 && (left[at(3.5)] - 0.5).abs() < 1e-3);
    assert!(left[at(2.01)..at(2.99)].iter().all(|sample| *sample == 0.0));
    assert!(largest_step(&left) < 0.5 / 200.0, "{}", largest_step(&left));
    // Playback pauses in the gap, and the block is written meanwhile.
    bench.line(2.2 * 4096.0 / RATE, 1.0);
    let waiting = bench.play(0.02);
    made.write(2, vec![[16_384; 2]; 4096]);
    let going = bench.play(0.04);
    assert!(waiting[480..].iter().all(|sample| *sample == 0.0));
    assert!((going[600] - 0.5).abs() < 1e-3, "{}", going[600]);
    assert!(largest_step(&[&waiting[480..], &going[..]].concat()) < 0.5 / 200.0);
}

#[test]
fn clock_drift_of_a_device_is_corrected() {
    // A sample encodes its position within 2,000 samples, 45 ms.
    let frames = (0..1_500_000).map(|n| [((n % 2000) as f32 - 1000.0) * 1e-4; 2]).collect();
    let saw = Arc::new(Sound { frames, truncated: false });
    // Crystals differ by up to 100 ppm; 1000 ppm is a bad one.
    for drift in [1e-4, -1e-4, 1e-3] {
        let mut bench = Bench::new(48_000, scene(&[Source::Loop(saw.clone())]));
        bench.drift = drift;
        bench.line(0.0, 1.0);
        bench.play(29.0);
        let line = bench.desired.line.unwrap();
        let (start, left) = (bench.now(), bench.play(1.0));
        let mut worst = 0.0_f64;
        for n in (0..left.len()).step_by(97) {
            let heard_at = start + Duration::from_secs_f64(n as f64 / 48_000.0 / (1.0 + drift));
            let place = line.position_at(heard_at).rem_euclid(2000.0);
            if (300.0..1700.0).contains(&place) {
                worst = worst.max((f64::from(left[n]) * 1e4 + 1000.0 - place).abs() / RATE);
            }
        }
        // Without correction the sound would be 3 ms and 30 ms off by now.
        assert!(worst < 2.0 * drift.abs() + 3e-4, "{worst} s off at {drift}");
        assert_eq!(bench.remote.state.jumps(), 0);
    }
}

#[test]
fn sound_catches_up_after_a_device_stalls() {
    let mut bench = Bench::new(44_100, scene(&[Source::Loop(ramp(900_000))]));
    bench.line(0.0, 1.0);
    bench.play(1.0);
    bench.start += Duration::from_millis(150);
    let left = bench.play(0.5);
    let (line, at) = (bench.desired.line.unwrap(), bench.now() - Duration::from_secs_f64(1.0 / RATE));
    assert!((f64::from(left[left.len() - 1]) * 1e6 - line.position_at(at)).abs() < 0.001 * RATE);
    assert_eq!(bench.remote.state.jumps(), 1);
}

#[test]
fn sources_are_summed_clipped_and_turned_down() {
    let loud = |value: f32| Source::Loop(Arc::new(Sound { frames: vec![[value, -value]; 1000], truncated: false }));
    let mut bench = Bench::new(44_100, scene(&[loud(0.7), loud(0.2)]));
    bench.line(0.0, 1.0);
    assert!((bench.play(0.1)[4000] - 0.9).abs() < 1e-6);
    bench.order(|desired| desired.scene = scene(&[loud(0.7), loud(0.7)]));
    assert_eq!(bench.play(0.1)[4000], 1.0);
    bench.order(|desired| desired.gain = 0.5);
    let down = bench.play(0.1);
    assert!((down[4000] - 0.7).abs() < 1e-6, "turned down before it is clipped");
    bench.order(|desired| desired.gain = 0.0);
    let mute = bench.play(0.1);
    assert_eq!(mute[4000], 0.0);
    assert!(largest_step(&[down, mute].concat()) < 0.002, "a volume turns, it does not jump");
    let mut odd = [9.0; 9];
    let now = bench.now();
    bench.order(|desired| desired.gain = 1.0);
    bench.mixer.fill(&mut odd, 3, now);
    assert!((0..3).all(|n| odd[3 * n + 2] == 0.0), "further channels are silent");
    bench.mixer.fill(&mut [], 0, now);
}

#[test]
fn finished_scenes_are_freed_by_the_sender() {
    let sound = ramp(1000);
    let mut bench = Bench::new(44_100, scene(&[Source::Loop(sound.clone())]));
    bench.line(0.0, 1.0);
    bench.play(0.1);
    bench.order(|desired| desired.scene = Arc::default());
    bench.play(0.1);
    bench.order(|_| {});
    bench.play(0.1);
    assert_eq!(Arc::strong_count(&sound), 1);
    // Orders that are not taken are dropped; the sender does not block.
    let taken = (0..100).filter(|_| bench.remote.send(&bench.desired)).count();
    assert_eq!(taken, ORDERS);
    bench.play(0.01);
    assert!(bench.remote.send(&bench.desired));
}

#[test]
fn files_with_nan_and_infinities_are_played_as_finite_samples() {
    let frames = vec![[f32::NAN, f32::INFINITY], [f32::NEG_INFINITY, 1e30]];
    let mut bench = Bench::new(48_000, scene(&[Source::Loop(Arc::new(Sound { frames, truncated: false }))]));
    bench.line(0.0, 1.7);
    assert!(bench.play(0.1).iter().all(|sample| sample.abs() <= 1.0));
}
