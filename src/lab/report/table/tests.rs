use super::*;
use crate::{HardCase, SpeedComparison, cost::Clock, metrics::Norms};

const METHODS: [Method; 3] = [
    Method { name: "own", title: "Own", settings: &[1.0, 2.0], usual: 1.0 },
    Method { name: "far", title: "Far", settings: &[1.0, 2.0], usual: 1.0 },
    Method { name: "unsafe", title: "Unsafe", settings: &[1.0, 2.0], usual: 1.0 },
];

/// Returns a row of 1 x 1 texels with this time and this error.
fn row(method: &'static Method, setting: f64, millis: f64, error: f64, passed: bool) -> Row {
    let times = Times { median: millis, min: millis, max: millis };
    let point = Point { study: "s".into(), method: method.name.into(), setting, grid: 1 };
    let case = HardCase { name: "case".into(), passed, detail: String::new() };
    let norms = Norms { l1: error, l2: error, linf: error };
    let cost = Cost {
        frame: times,
        copy: times,
        empty: times,
        bytes_per_texel: 1.0,
        texels_per_texel: 1.0,
        canvas_texels: 1.0,
        repeats: 7,
        batch: 1,
        clock: Clock::Wall,
    };
    Row {
        method,
        point,
        measured: Some(Measured { norms, hard: vec![case], frames_per_unit: 1.0, ..Measured::default() }),
        trouble: None,
        cost: Some(cost),
        millis: Some(times),
        is_frontier: false,
        is_dominated: false,
    }
}

fn table(rows: Vec<Row>, peers: &'static [&'static str]) -> Table {
    let study = Box::leak(Box::new(Study {
        parameter: "dt",
        signed: Some("energy_error"),
        race: Some(SpeedComparison { method: "own", peers, peers_are: "one-pass settings" }),
        ..Study::of(|_| unreachable!(), |_, _| unreachable!())
    }));
    Table { study, grid: 1, rows, convergence: Vec::new() }
}

/// The errors of the fluid's best method at steps from long to short, and whether too much energy remains.
const CANCELS: [(f64, f64, f64); 6] = [
    (9.6, 6.1e-3, -1.0),
    (4.8, 1.4e-3, -1.0),
    (2.4, 2.0e-4, -1.0),
    (1.2, 1.3e-5, 1.0),
    (0.6, 1.4e-4, 1.0),
    (0.3, 5.9e-5, 1.0),
];

fn best_of(points: &[(f64, f64, f64)]) -> Option<Best> {
    let [own, ..] = &METHODS;
    let rows = points.iter().map(|&(setting, error, sign)| {
        // Half the step is twice the cost.
        let mut row = row(own, setting, 12.0 / setting, error, true);
        let values = &mut row.measured.as_mut().unwrap().values;
        values.insert("energy_error".into(), Number(sign * error));
        row
    });
    table(rows.collect(), &[]).best(own)
}

#[test]
fn errors_that_cancel_are_not_the_best() {
    let best = best_of(&CANCELS).unwrap();
    assert_eq!(best, Best { error: 1.4e-4, setting: 1.2, millis: 10.0, turn: Some([2.4, 1.2]) });
    // In any order of measurement, and if the smallest error is before the change of sign.
    let mut other = CANCELS;
    other.reverse();
    assert_eq!(best_of(&other), Some(best));
    (other[2].1, other[3].1) = (9e-5, 1e-5);
    let before = best_of(&other).unwrap();
    assert_eq!((before.error, before.setting, before.turn), (1.4e-4, 2.4, Some([2.4, 1.2])));
    // A method whose error continues to fall, one that never changes its sign, and one that is best at a step in the
    // middle without a change of sign, have their smallest error as the best.
    let falls = best_of(&[CANCELS[0], CANCELS[1], CANCELS[2], CANCELS[3]]).unwrap();
    assert_eq!((falls.error, falls.setting, falls.turn), (1.3e-5, 1.2, None));
    let middle = best_of(&CANCELS.map(|(setting, error, _)| (setting, error, 1.0))).unwrap();
    assert_eq!((middle.error, middle.setting, middle.turn), (1.3e-5, 1.2, None));
    assert_eq!(best_of(&[]), None);
}

#[test]
fn races_name_the_times_and_the_methods_that_never_arrive() {
    let [own, far, unsafe_] = &METHODS;
    let rows = || {
        vec![
            row(own, 1.0, 2.0, 0.1, true),
            row(own, 2.0, 4.0, 0.01, true),
            row(far, 1.0, 10.0, 0.4, true),
            row(far, 2.0, 20.0, 0.2, true),
            row(unsafe_, 1.0, 60.0, 0.01, false),
        ]
    };
    let both = table(rows(), &["far", "unsafe"]);
    assert_eq!([own, far, unsafe_].map(|m| both.reach(m)), [Reach::In(4.0), Reach::Never, Reach::Failing(60.0)]);
    let said = both.verdict().unwrap();
    assert!(said.contains("Own reaches") && said.contains("Unsafe") && said.contains("15.0 times as long"), "{said}");
    let said = table(rows(), &["far"]).verdict().unwrap();
    assert!(said.contains("none reaches it") && said.contains("Far at dt = 2") && said.contains("20.0 %"), "{said}");
    assert!(said.contains("5.0 times as long"), "{said}");
    let slow = table(rows().split_off(2), &["far"]);
    assert_eq!(slow.verdict(), None, "nothing of the method is known");
    let never = table(vec![row(own, 1.0, 2.0, 0.1, true)], &["far"]).verdict().unwrap();
    assert!(never.contains("does not reach"), "{never}");
}

#[test]
fn studies_without_a_contest_have_no_winner() {
    for is_contest in [true, false] {
        let study = Box::leak(Box::new(Study {
            name: "s",
            methods: &METHODS,
            is_contest,
            has_order: false,
            grids: [[1; 3]; 2],
            ..Study::of(|_| unreachable!(), |_, _| unreachable!())
        }));
        let mut results = Results::default();
        results.runs.push(crate::Provenance {
            device: String::new(),
            driver: String::new(),
            version: String::new(),
            extent: Extent::Full,
            repeats: 7,
            seed: 0,
            beside_window: false,
        });
        for (method, error) in METHODS[..2].iter().zip([0.1, 0.2]) {
            let Row { point, measured, .. } = row(method, 1.0, 1.0, error, true);
            results.errors.push(crate::ErrorRecord { point, setup: None, measured, trouble: None });
        }
        let table = Table::with_estimates(study, &results, |_| Some(1.0)).unwrap();
        let looks: Vec<Look> = table.rows.iter().map(Row::look).collect();
        assert_eq!(looks, if is_contest { [Look::Full, Look::Grey] } else { [Look::Full, Look::Full] });
        assert_eq!(table.frontier().len(), usize::from(is_contest));
    }
}
