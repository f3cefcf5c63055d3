use super::{csv::write as write_csv, measuring::Measured, *};
use crate::{drawing::Ticket, read_back::ReadBack, template};
use eddy_project::{Project, Tab};
use std::time::{Duration, Instant};

fn sample(frame: i32, value: f64) -> Sample {
    Sample { frame, time_secs: f64::from(frame) / 60.0, value }
}

fn recorded(values: impl IntoIterator<Item = f64>) -> Record {
    let mut record = Record::default();
    (0..).zip(values).for_each(|(frame, value)| record.push(sample(frame, value), false));
    record
}

/// Pseudo-random values, the same on each run.
fn noise(frame: i32) -> f64 {
    f64::from((frame as u32).wrapping_mul(2_654_435_761) >> 8) / f64::from(1 << 24) - 0.5
}

fn is_in_order(record: &Record) -> bool {
    let frames: Vec<i32> = record.samples().map(|sample| sample.frame).collect();
    frames.is_sorted_by(|a, b| a < b)
}

#[test]
fn samples_within_the_limit_are_unchanged() {
    let record = recorded((0..MOST as i32).map(noise));
    assert_eq!(record.samples().count(), MOST);
    assert!((0..).zip(record.samples()).all(|(frame, kept)| kept == sample(frame, noise(frame))));
    // With one more, cells have a minimum and a maximum.
    let record = recorded((0..=MOST as i32).map(noise));
    assert!((MOST / 3..=MOST).contains(&record.samples().count()), "{}", record.samples().count());
    assert_eq!(record.newest(), Some(sample(MOST as i32, noise(MOST as i32))));
}

#[test]
fn millions_of_samples_fit_and_keep_every_spike() {
    const SPIKES: [(i32, f64); 4] = [(3, 900.0), (77_777, -300.0), (1_234_567, 400.0), (2_999_998, -901.0)];
    let value = |frame: i32| SPIKES.iter().find(|spike| spike.0 == frame).map_or(noise(frame), |spike| spike.1);
    let mut record = Record::default();
    for frame in 0..3_000_000 {
        record.push(sample(frame, value(frame)), false);
        if frame % 997 == 0 {
            assert!(record.samples().count() <= MOST, "frame {frame}");
        }
    }
    let count = record.samples().count();
    assert!((MOST / 3..=MOST).contains(&count) && is_in_order(&record), "{count}");
    assert_eq!(record.extremes(), Some((-901.0, 900.0)));
    for (frame, value) in SPIKES {
        assert!(record.samples().any(|kept| kept == sample(frame, value)), "{frame}");
    }
    // Every interval of frames has its own minimum and maximum.
    for cell in record.cells() {
        let kept: Vec<Sample> = cell.samples().collect();
        assert!(kept.len() <= 2 && kept.iter().all(|kept| kept.value == value(kept.frame)));
    }
    assert_eq!(record.newest(), Some(sample(2_999_999, value(2_999_999))));
}

#[test]
fn frame_numbers_may_be_any_integer() {
    let mut record = Record::default();
    for frame in (0..i32::MAX - 70_000).step_by(65_536).chain(i32::MAX - 5_000..=i32::MAX) {
        record.push(sample(frame, noise(frame)), false);
        assert!(record.samples().count() <= MOST);
    }
    // When the frame number saturates, the newest value is kept.
    record.push(sample(i32::MAX, 7.0), false);
    assert_eq!(record.newest(), Some(sample(i32::MAX, 7.0)));
    assert!(is_in_order(&record) && record.extremes().unwrap().1 == 7.0);
}

#[test]
fn nonfinite_samples_are_kept_separately() {
    let record = recorded((0..100_000).map(|frame| match frame {
        50 => f64::NAN,
        60_000 => f64::INFINITY,
        99_000 => f64::NEG_INFINITY,
        frame => f64::from(frame),
    }));
    let bad: Vec<i32> =
        record.samples().filter(|sample| !sample.value.is_finite()).map(|sample| sample.frame).collect();
    assert_eq!(bad, [50, 60_000, 99_000]);
    assert_eq!(record.extremes(), Some((0.0, 99_999.0)));
    // Nothing but NaN: the limit is the same.
    let record = recorded((0..100_000).map(|_| f64::NAN));
    assert!(record.samples().count() <= MOST && record.extremes().is_none());
    assert!(record.newest().unwrap().value.is_nan());
}

#[test]
fn going_back_drops_later_samples() {
    let mut record = recorded((0..10).map(f64::from));
    record.push(sample(4, 40.0), false);
    let kept = |record: &Record| record.samples().map(|sample| sample.value).collect::<Vec<_>>();
    assert_eq!(kept(&record), [0.0, 1.0, 2.0, 3.0, 40.0]);
    record.keep_before(3);
    assert_eq!((kept(&record), record.newest()), (vec![0.0, 1.0, 2.0], Some(sample(2, 2.0))));
    record.keep_before(9);
    assert_eq!(kept(&record), [0.0, 1.0, 2.0]);
    record.keep_before(0);
    assert!(kept(&record).is_empty() && record.newest().is_none());
    // A record that was thinned has its full resolution again after a restart.
    let mut record = recorded((0..100_000).map(noise));
    let before = record.samples().take_while(|kept| kept.frame < 70_000).count();
    record.keep_before(70_000);
    assert_eq!(record.samples().count(), before);
    record.push(sample(0, 1.0), false);
    record.push(sample(1, 2.0), false);
    record.push(sample(2, 1.5), false);
    assert_eq!(kept(&record), [1.0, 2.0, 1.5]);
}

#[test]
fn gaps_longer_than_a_cell_are_kept() {
    let mut record = recorded((0..3_000).map(noise));
    (10_000..13_000).for_each(|frame| record.push(sample(frame, noise(frame)), frame == 10_000));
    let gaps: Vec<i32> = record
        .cells()
        .iter()
        .filter(|cell| cell.is_after_gap)
        .map(|cell| cell.samples().next().unwrap().frame)
        .collect();
    assert!(gaps.len() == 1 && (10_000..10_008).contains(&gaps[0]), "{gaps:?}");
}

fn project(image: &str) -> Project {
    let mut project = template::project();
    project.source_mut(&Tab::image()).unwrap().text = image.into();
    project
}

/// The comments, each with its line.
fn summaries(measuring: &Measurements) -> Vec<(u64, &str, usize, bool)> {
    measuring
        .measures()
        .iter()
        .map(|m| (m.serial, m.text.as_str(), m.place.line, m.record.newest().is_some()))
        .collect()
}

/// Draws a frame, and measures what is due.
fn draw(measuring: &mut Measurements, frame: i32, now: Instant, is_running: bool) -> Option<usize> {
    measuring.start_frame(frame);
    let wanted = measuring.due(now, true, is_running).map(|wanted| wanted.0);
    if let Some(wanted) = &wanted {
        let values = wanted.iter().map(|(serial, _)| (*serial, Some(0.5))).collect();
        let measured = Measured { frame, time_secs: 0.0, values };
        measuring.ticket = Ticket::finished(Some(measured), Duration::from_millis(2));
    }
    measuring.receive(true);
    wanted.map(|wanted| wanted.len())
}

#[test]
fn record_is_kept_until_the_text_of_its_comment_changes() {
    let (mut measuring, now) = (Measurements::default(), Instant::now());
    measuring.follow(&project("//@probe max(image.x)\n//@probe min(image)\n"), (1, 1));
    measuring.watch(vec![1, 2]);
    draw(&mut measuring, 0, now, false);
    assert_eq!(draw(&mut measuring, 1, now, false), Some(2));
    assert_eq!(summaries(&measuring), [(1, "max(image.x)", 1, true), (2, "min(image)", 2, true)]);
    // With another text, on a later line, and the second one duplicated.
    let more = "float a;\n//@probe max(image.x)\n//@probe min(image)\n//@probe min(image)\n";
    assert!(measuring.follow(&project(more), (1, 2)) && !measuring.follow(&project(more), (1, 2)));
    assert_eq!(
        summaries(&measuring),
        [(1, "max(image.x)", 2, true), (2, "min(image)", 3, true), (3, "min(image)", 4, false)]
    );
    measuring.follow(&project("//@probe max(image.y)\n//@probe min(image)\n"), (1, 3));
    assert_eq!(summaries(&measuring), [(4, "max(image.y)", 1, false), (2, "min(image)", 2, true)]);
    let mut measuring = measuring.successor();
    measuring.follow(&project("//@probe min(image)\n"), (2, 3));
    assert_eq!(summaries(&measuring), [(5, "min(image)", 1, false)]);
}

#[test]
fn unmeasurable_comments_have_a_reason_and_are_not_requested() {
    let (mut measuring, now) = (Measurements::default(), Instant::now());
    let text = "//@probe total(image)\n//@probe sum(buffer_q)\n//@probe max(image:2)\n//@probe max(image)\n";
    measuring.follow(&project(text), (1, 1));
    let why = |at: usize| measuring.measures()[at].quantity.clone().unwrap_err();
    assert!(why(0).why.contains("not `total`") && why(0).hint.contains("the form is"), "{:?}", why(0));
    assert!(why(1).why.contains("no pass buffer_q") && why(1).hint.contains("are image"), "{:?}", why(1));
    assert!(why(2).why.contains("no target 2"), "{:?}", why(2));
    measuring.watch(vec![1, 2, 3, 4]);
    assert_eq!(measuring.due(now, false, false).map(|wanted| wanted.0.len()), Some(1));
    measuring.watch(vec![1, 2, 3]);
    measuring.receive(true);
    assert_eq!(measuring.due(now, false, false), None);
}

#[test]
fn only_watched_comments_are_measured_within_the_time_share() {
    let (mut measuring, now) = (Measurements::default(), Instant::now());
    measuring.follow(&project("//@probe max(image.x)\n//@probe min(image)\n"), (1, 1));
    assert_eq!(draw(&mut measuring, 0, now, true), None);
    measuring.watch(vec![2]);
    assert_eq!(draw(&mut measuring, 1, now, true), Some(1));
    let millis = |n: u64| now + Duration::from_millis(n);
    assert_eq!(draw(&mut measuring, 2, millis(39), true), None, "2 ms of 40");
    assert_eq!(draw(&mut measuring, 3, millis(40), true), Some(1));
    assert_eq!(draw(&mut measuring, 4, millis(41), false), Some(1), "paused, each frame");
    assert_eq!(measuring.due(millis(500), false, false), None, "and once");
    measuring.watch(vec![]);
    assert_eq!(draw(&mut measuring, 5, millis(900), false), None);
    assert_eq!(measuring.count(), 3);
    // Frames that were not watched are a gap; frames that had to wait are not.
    measuring.watch(vec![2]);
    assert_eq!(draw(&mut measuring, 6, millis(950), false), Some(1));
    let gaps: Vec<bool> = measuring.measures()[1].record.cells().iter().map(|cell| cell.is_after_gap).collect();
    assert_eq!(gaps, [true, false, false, true]);
}

#[test]
fn reset_or_seek_back_truncates_the_record() {
    let (mut measuring, now) = (Measurements::default(), Instant::now());
    measuring.follow(&project("//@probe max(image.x)\n"), (1, 1));
    measuring.watch(vec![1]);
    let frames =
        |measuring: &Measurements| measuring.measures()[0].record.samples().map(|s| s.frame).collect::<Vec<_>>();
    (0..6).for_each(|frame| assert!(draw(&mut measuring, frame, now, false).is_some()));
    measuring.go_to(3);
    assert_eq!(frames(&measuring), [0, 1, 2, 3]);
    draw(&mut measuring, 4, now, false);
    assert_eq!(frames(&measuring), [0, 1, 2, 3, 4]);
    // A frame that is not measured truncates the record as well.
    measuring.start_frame(0);
    assert!(frames(&measuring).is_empty());
    measuring.receive(true);
    draw(&mut measuring, 1, now, false);
    assert_eq!(frames(&measuring), [1]);
    measuring.clear();
    assert!(frames(&measuring).is_empty());
}

#[test]
fn a_table_has_a_row_for_each_frame() {
    let mut measuring = Measurements::default();
    let text = "//@probe max(image.x)\n//@probe total(image)\n//@probe min(image)\n//@probe min(image)\n";
    measuring.follow(&project(text), (1, 1));
    let mut measured = |frame: i32, values: &[(u64, Option<f64>)]| {
        let measured = Measured { frame, time_secs: f64::from(frame) / 4.0, values: values.to_vec() };
        measuring.ticket = Ticket::finished(Some(measured), Duration::ZERO);
        measuring.receive(true);
    };
    measured(1, &[(1, Some(0.1)), (3, Some(f64::NAN))]);
    measured(2, &[(1, None), (3, Some(1e300)), (4, Some(f64::NEG_INFINITY))]);
    let mut table = Vec::new();
    write_csv(&mut table, measuring.measures()).unwrap();
    let rows = "frame,time,max(image.x),min(image) Image:3,min(image) Image:4\n1,0.25,0.1,NaN,\n2,0.5,,1e300,-inf\n";
    assert_eq!(String::from_utf8(table).unwrap(), rows);
}
