use super::*;
use crate::lab::{
    CostRecord, HardCase, Measured, Provenance, Record,
    cost::{Clock, Cost, Times},
    metrics::Norms,
    studies,
};
use egui::pos2;

/// The first study, its points on the main grid, and a run that has just started.
fn started_study() -> (&'static Study, Vec<Point>, ExtentResults) {
    let study = studies::all()[0];
    let main = study.main_grid(Extent::Quick);
    let points = study.points(Extent::Quick).into_iter().filter(|p| p.grid == main).collect();
    let text = || "x".to_owned();
    let mut results = Results::default();
    results.add(Record::Run(Provenance {
        device: text(),
        driver: text(),
        version: text(),
        extent: Extent::Quick,
        repeats: 7,
        seed: 1,
        beside_window: true,
    }));
    let mut known = ExtentResults::default();
    assert!(known.take(&Event::Resumed(results)));
    (study, points, known)
}

fn measured(point: &Point, l2: f64, passes: bool) -> Event {
    let norms = Norms { l1: l2, l2, linf: l2 };
    let measured = Measured { norms, frames_per_unit: 10.0, ..Measured::default() };
    let measured = measured.hard(HardCase::at_most("case", if passes { 0.0 } else { 2.0 }, 1.0));
    Event::Measured(ErrorRecord { point: point.clone(), setup: None, measured: Some(measured), trouble: None })
}

fn costed(point: &Point, millis: f64) -> Event {
    let frame = Times { median: millis, min: millis, max: millis };
    let cost = Cost {
        frame,
        copy: frame,
        empty: frame,
        bytes_per_texel: 32.0,
        texels_per_texel: 1.0,
        canvas_texels: 1e4,
        repeats: 7,
        batch: 1,
        clock: Clock::Wall,
    };
    Event::Costed(CostRecord { point: point.clone(), setup: None, cost })
}

#[test]
fn points_move_from_their_estimated_to_their_measured_cost() {
    let (study, points, mut known) = started_study();
    assert!(known.shown(study).is_none());
    known.take(&measured(&points[0], 0.01, true));
    // Without a cost it has no place.
    assert_eq!(known.shown(study).unwrap().dots, []);
    known.take(&Event::Estimate { point: points[0].clone(), millis: 0.1 });
    let shown = known.shown(study).unwrap();
    // Ten frames of 0.1 ms, error 0.01.
    assert!((shown.dots[0].at[0] - 0.0).abs() < 1e-12 && (shown.dots[0].at[1] + 2.0).abs() < 1e-12);
    assert!(shown.dots[0].is_estimate);
    known.take(&costed(&points[0], 1.0));
    let shown = known.shown(study).unwrap();
    assert!((shown.dots[0].at[0] - 1.0).abs() < 1e-12 && !shown.dots[0].is_estimate);
    assert_eq!(shown.bounds.unwrap(), [(0.0, 2.0), (-3.0, -1.0)]);
    assert_eq!(known.estimates, []);
}

#[test]
fn dots_match_the_report() {
    let (study, points, mut known) = started_study();
    let looks = [(0.1, 1.0, true), (0.01, 2.0, true), (0.2, 3.0, true), (0.001, 0.5, false)];
    for ((error, millis, passes), point) in looks.into_iter().zip(&points) {
        known.take(&measured(point, error, passes));
        known.take(&costed(point, millis));
    }
    let shown = known.shown(study).unwrap();
    let mut looks: Vec<(i64, Look)> = shown.dots.iter().map(|d| ((10.0 * d.at[0]).round() as i64, d.look)).collect();
    looks.sort_by_key(|(x, _)| *x);
    assert_eq!(looks.iter().map(|l| l.1).collect::<Vec<_>>(), [Look::Hollow, Look::Full, Look::Full, Look::Grey]);
    // One stair from the cheap one down to the accurate one; a method that fails a hard case is excluded.
    assert_eq!(shown.frontier.len(), 3);
    assert_eq!(shown.frontier[1][1], shown.frontier[0][1]);
}

#[test]
fn diverged_points_are_listed_without_a_dot() {
    let (study, points, mut known) = started_study();
    known.take(&measured(&points[0], f64::INFINITY, true));
    known.take(&costed(&points[0], 1.0));
    let shown = known.shown(study).unwrap();
    assert_eq!((shown.dots.len(), shown.without_place(shown.methods[0]).count()), (0, 1));
    assert!(shown.bounds.is_none());
    assert!(!known.is_whole(study, Extent::Quick));
}

#[test]
fn clicks_select_the_nearest_point_within_reach() {
    let places = [pos2(0.0, 0.0), pos2(10.0, 0.0), pos2(10.0, 4.0)];
    let at = |x, y| nearest(places, pos2(x, y), 12.0);
    assert_eq!((at(1.0, 1.0), at(9.0, 0.5), at(10.0, 3.0), at(40.0, 0.0)), (Some(0), Some(1), Some(2), None));
    // Of two in the same place the one drawn later, which is visible.
    assert_eq!(nearest([pos2(5.0, 5.0), pos2(5.0, 5.0)], pos2(5.0, 6.0), 12.0), Some(1));
    assert_eq!(nearest([], pos2(0.0, 0.0), 12.0), None);
}
