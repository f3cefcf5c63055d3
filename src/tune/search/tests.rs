//! The search on synthetic programs, whose frontier is known by trying everything.

use super::{Goal, Ladder, Measure, Point, Search, frontier};

/// A program: time and error of a setting.
struct Synthetic<F> {
    program: F,
    calls: usize,
    most: usize,
}

impl<F: Fn(&[f64]) -> Option<(f64, f64)>> Measure<()> for Synthetic<F> {
    fn measure(&mut self, values: &[f64]) -> Result<Option<Point>, ()> {
        self.calls += 1;
        Ok((self.program)(values).map(|(millis, error)| Point { values: values.to_vec(), millis, error }))
    }

    fn has_time(&self) -> bool {
        self.calls < self.most
    }
}

fn ladder(values: &[f64]) -> Ladder {
    Ladder { values: values.to_vec(), is_continuous: true, is_integer: true }
}

/// Returns the best that the search found, the best of all settings, and the number of measurements.
fn search(program: impl Fn(&[f64]) -> Option<(f64, f64)>, tops: &[f64], goal: Goal) -> (Point, Point, usize) {
    let ladders: Vec<Ladder> = tops
        .iter()
        .map(|top| ladder(&(0..4).rev().map(|k| (top / f64::from(1 << k)).round().max(1.0)).collect::<Vec<_>>()))
        .map(|mut ladder| {
            ladder.values.dedup();
            ladder
        })
        .collect();
    let mut subject = Synthetic { program, calls: 0, most: 60 };
    let mut search = Search::default();
    let base = subject.measure(tops).unwrap().unwrap();
    search.add(base);
    let order: Vec<usize> = (0..tops.len()).collect();
    search.one_at_a_time(&mut subject, tops, &ladders, (&vec![true; tops.len()], &order), 0.2).unwrap();
    search.run(&mut subject, tops, &ladders, goal).unwrap();
    let best = goal.best(search.points.iter()).unwrap().clone();
    let mut all = vec![Vec::new()];
    for (top, ladder) in tops.iter().zip(&ladders) {
        let range: Vec<f64> = (ladder.values[0] as i32..=*top as i32).map(f64::from).collect();
        all = all.iter().flat_map(|b: &Vec<f64>| range.iter().map(|v| [b.clone(), vec![*v]].concat())).collect();
    }
    let all: Vec<Point> = all
        .into_iter()
        .filter_map(|values| {
            let (millis, error) = (subject.program)(&values)?;
            Some(Point { values, millis, error })
        })
        .collect();
    let truth = goal.best(all.iter()).unwrap().clone();
    (best, truth, subject.calls)
}

#[test]
fn products_and_sums_are_found_with_few_measurements() {
    let nested = |v: &[f64]| {
        Some((1.0 + 0.01 * v[0] * v[1] * v[1], 0.5 * (-v[0] / 12.0).exp() + 0.02 / (v[1] * v[1]) - 0.00125))
    };
    let (found, best, calls) = search(nested, &[128.0, 4.0], Goal::Error(0.02));
    assert!(found.error <= 0.02 && found.millis <= 1.1 * best.millis, "{found:?} {best:?}");
    assert!(calls <= 40, "{calls}");
    let passes = |v: &[f64]| Some((2.0 + 0.1 * v[0] + 0.05 * v[1] + 0.4 * v[2], 0.3 / v[0] + 0.5 / v[1] + 0.02 / v[2]));
    let (found, best, calls) = search(passes, &[64.0, 96.0, 16.0], Goal::Error(0.05));
    assert!(found.error <= 0.05 && found.millis <= 1.1 * best.millis, "{found:?} {best:?}");
    assert!(calls <= 60, "{calls}");
    let (found, best, _) = search(passes, &[64.0, 96.0, 16.0], Goal::Budget(8.0));
    assert!(found.millis <= 8.0 && found.error <= 1.15 * best.error, "{found:?} {best:?}");
}

#[test]
fn settings_that_cannot_be_drawn_and_bounds_that_nothing_meets_are_survived() {
    let odd = |v: &[f64]| (v[0] != 16.0).then_some((v[0], 1.0 / v[0]));
    let (found, best, _) = search(odd, &[64.0], Goal::Error(0.06));
    assert!(found.error <= 0.06 && found.millis <= 1.15 * best.millis, "{found:?} {best:?}");
    let (found, ..) = search(|v| Some((v[0], 1.0 / v[0])), &[64.0], Goal::Error(0.001));
    assert_eq!(found.values, [64.0], "the closest is the most exact");
}

#[test]
fn the_frontier_has_what_nothing_beats() {
    let point = |millis: f64, error: f64| Point { values: vec![millis], millis, error };
    let points =
        [point(3.0, 0.1), point(1.0, 0.5), point(2.0, 0.6), point(4.0, 0.1), point(5.0, f64::NAN), point(6.0, 0.0)];
    let times: Vec<f64> = frontier(&points).iter().map(|p| p.millis).collect();
    assert_eq!(times, [1.0, 3.0, 6.0]);
}

#[test]
fn steps_are_refined_around_a_value_within_the_range() {
    let coarse = ladder(&[8.0, 16.0, 32.0]);
    assert_eq!(coarse.refined(16.0, 0.5).values, [8.0, 11.0, 16.0, 23.0, 32.0]);
    assert_eq!(coarse.refined(32.0, 0.5).values, [8.0, 16.0, 23.0, 32.0]);
    let floats = Ladder { values: vec![0.1, 0.2], is_continuous: true, is_integer: false };
    assert_eq!(floats.refined(0.2, 0.5).values, [0.1, 0.141, 0.2]);
    assert_eq!(
        Ladder { is_continuous: false, ..coarse.clone() }.refined(16.0, 0.5),
        Ladder { is_continuous: false, ..coarse }
    );
}

#[test]
fn smaller_pictures_say_what_to_draw() {
    // Errors of the size that counts are two thirds of those of small pictures, and times nine times as long.
    let small = |v: &[f64]| Some((1.0 + 0.01 * v[0] * v[1] * v[1], 0.5 * (-v[0] / 12.0).exp() + 0.03 / (v[1] * v[1])));
    let large = |v: &[f64]| small(v).map(|(millis, error)| (9.0 * millis, error / 1.5));
    let (tops, goal) = ([128.0, 4.0], Goal::Error(0.02));
    let ladders = [ladder(&[16.0, 32.0, 64.0, 128.0]), ladder(&[1.0, 2.0, 3.0, 4.0])];
    let mut subject = Synthetic { program: small, calls: 0, most: 60 };
    let mut first = Search::default();
    first.add(subject.measure(&tops).unwrap().unwrap());
    first.one_at_a_time(&mut subject, &tops, &ladders, (&[true; 2], &[0, 1]), 0.2).unwrap();
    first.run(&mut subject, &tops, &ladders, goal).unwrap();
    let mut subject = Synthetic { program: large, calls: 0, most: 60 };
    let mut second = Search::after(first.points);
    second.add(subject.measure(&tops).unwrap().unwrap());
    second.run(&mut subject, &tops, &ladders, goal).unwrap();
    let best = goal.best(second.points.iter()).unwrap();
    let all = (1..=128).flat_map(|a| (1..=4).map(move |b| [f64::from(a), f64::from(b)]));
    let all: Vec<Point> = all
        .filter_map(|values| large(&values).map(|(millis, error)| Point { values: values.to_vec(), millis, error }))
        .collect();
    let truth = goal.best(all.iter()).unwrap();
    assert!(best.error <= 0.02 && best.millis <= 1.1 * truth.millis, "{best:?} {truth:?}");
    assert!(subject.calls <= 14, "{}", subject.calls);
}

#[test]
fn settings_that_cannot_be_faster_are_not_measured() {
    struct Bounded(usize);
    impl Measure<()> for Bounded {
        fn measure(&mut self, values: &[f64]) -> Result<Option<Point>, ()> {
            self.0 += 1;
            Ok(Some(Point { values: values.to_vec(), millis: 10.0, error: 0.0 }))
        }
        fn has_time(&self) -> bool {
            true
        }
        // The second knob has no part in the time.
        fn least_part(&self, values: &[f64]) -> f64 {
            values[0] / 8.0
        }
    }
    let ladders = [ladder(&[2.0, 4.0, 8.0]), ladder(&[2.0, 4.0, 8.0])];
    let (mut search, mut subject) = (Search::default(), Bounded(0));
    search.one_at_a_time(&mut subject, &[8.0, 8.0], &ladders, (&[true; 2], &[1, 0]), 1.0).unwrap();
    assert_eq!((subject.0, search.points[0].values.clone()), (2, vec![4.0, 8.0]));
}
