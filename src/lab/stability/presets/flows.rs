//! Fluids, and quantities that are transported by a flow.

use super::declare::{Courant, PresetCase, always, by, mouse, picture};
use crate::{
    stability::check::{Allowed, Area, CaseConditions, Check, Quantity},
    stability_record::Kind,
};

type Bounds = (Vec<Check>, Option<Courant>);

/// Row 0 of the compressible fluids is the mouse's memory.
const FLUID: Area = Area::FromRow(1);

/// Returns c dt, nu dt and the time step of the compressible fluids, as in solver.glsl: (nu dt, K dt, dt).
fn steps(s: &CaseConditions) -> (f64, f64, f64) {
    let (dt, nu, k) = (s.slider("dt"), s.slider("viscosity"), s.slider("stiffness"));
    match is_classic(s) {
        true => (nu * dt, k * dt, dt),
        false => ((nu * dt).min(0.15), (k * dt).min(0.15 + 10.0 * nu * dt).min(0.45), dt),
    }
}

fn is_classic(s: &CaseConditions) -> bool {
    s.slider("form") == 0.0
}

const CLASSIC: &str = "the published form is unstable at rest where nu < K or nu dt > 1/4 (von Neumann)";
const SUPERSONIC: &str = "the published form lets a flow of speed 3 be faster than 0.4 of its sound here";
const NO_PRESSURE: &str = "without stiffness there is no pressure, and nothing keeps mass from piling up";

fn is_beyond_classic(s: &CaseConditions) -> bool {
    let (nu, k) = (s.slider("viscosity"), s.slider("stiffness"));
    is_classic(s) && (nu < k || nu * s.slider("dt") > 0.25)
}

/// The only limit of the published form is a speed. If that is slow relative to sound, its flow equals that of the
/// other form.
fn is_supersonic(s: &CaseConditions) -> bool {
    let (_, k, dt) = steps(s);
    is_classic(s) && 0.4 * k.sqrt() / dt < CLASSIC_SPEED
}

/// The speed limit of the published form, in solver.glsl.
const CLASSIC_SPEED: f64 = 3.0;

/// A range that is valid wherever the theory of sound in a fluid applies.
fn unless_theory(s: &CaseConditions, allowed: Allowed) -> Allowed {
    allowed
        .unless(is_beyond_classic(s), CLASSIC)
        .unless(s.slider("stiffness") == 0.0, NO_PRESSURE)
        .unless(is_supersonic(s), SUPERSONIC)
}

/// The speed up to which the step is stable, and to which all forces accelerate at most.
fn speed(s: &CaseConditions) -> Allowed {
    let (nu, k, dt) = steps(s);
    let sound = k.sqrt() / dt;
    let most = if is_classic(s) { CLASSIC_SPEED } else { (0.4 * sound).max(0.05) };
    let limit = ((1.0 - 4.0 * nu) / dt).clamp(0.05, most.max(0.05));
    // The jets and the mouse accelerate after the limit, to a speed of their own.
    let pushed = if is_classic(s) { CLASSIC_SPEED } else { 0.4 * sound };
    Allowed::new(0.0, limit.max(pushed) * 1.0001)
}

/// A flow of Mach M causes density differences of M^2 / 2 to M^2, its sound waves differences of M: 0.4 at most.
fn density(s: &CaseConditions) -> Allowed {
    unless_theory(s, Allowed::new(0.6, 1.6))
}

fn mass(s: &CaseConditions) -> Allowed {
    unless_theory(s, Allowed::new(0.98, 1.02))
}

fn smooth(s: &CaseConditions) -> Allowed {
    unless_theory(s, Allowed::new(0.0, 0.25))
}

const SPEED: &str = "the step is stable up to Mach 0.4, and every force pushes to less";
const DENSITY: &str = "at Mach 0.4 and below density differs from 1 by less than 0.4, and a wall doubles it at most";
const MASS: &str = "fluxes conserve mass; what the density's limits take comes back";
const SMOOTH: &str = "a field that alternates from cell to cell is an instability and no flow";

/// The checks for a compressible fluid in this pass.
fn compressible(name: &str) -> Vec<Check> {
    vec![
        by(name, Quantity::Length(0, 1), FLUID, speed, SPEED),
        by(name, Quantity::Component(2), FLUID, density, DENSITY),
        by(name, Quantity::Mean(2), FLUID, mass, MASS),
        by(name, Quantity::Roughness(0), FLUID, smooth, SMOOTH),
        by(name, Quantity::Roughness(1), FLUID, smooth, SMOOTH),
        by(name, Quantity::Roughness(2), FLUID, smooth, SMOOTH),
    ]
}

/// The jets would blow with about 1.8 cells per unit of time. The fluid's own limit allows that at most in the shortest
/// of the steps.
const COMPRESSIBLE: Courant = Courant {
    slider: "dt",
    value: |cells, _| cells / 1.8,
    speed: 0,
    cells: |speed, s| speed * s.slider("dt"),
    limit: Some(
        "the form that is not the published one holds every speed to Mach 0.4 and K dt to 0.45: at most \
         0.4 sqrt(0.45) = 0.268 cells a step, however long the step",
    ),
};

/// A case in which theory predicts that the published form is stable: nu >= K, nu dt <= 1/4, and a speed limit
/// below 0.4 of the speed of sound.
pub(super) fn stable_classic() -> PresetCase {
    PresetCase::new(Kind::Pairs, &[("form", 0.0), ("viscosity", 1.25), ("stiffness", 1.2), ("dt", 0.02)])
}

pub(super) fn fluid() -> Bounds {
    let mut checks = compressible("c");
    let reason = "paint is a mean of paints: its colour and its thickness are at most 1";
    checks.push(always("d", Quantity::Any, FLUID, (0.0, 1.0001), reason));
    let reason = "paper and paint are at most 1; the sun lights a slope by 1.42 and gleams by 0.55, to the power 0.8";
    checks.push(picture(1.73, reason));
    (checks, Some(COMPRESSIBLE))
}

pub(super) fn fluid_dye() -> Bounds {
    let mut checks = compressible("a");
    // Two nozzles and a brush of twice their weight, and the dye of each until it has decayed.
    let rule =
        |s: &CaseConditions| Allowed::new(0.0, 4.0 * s.slider("pours") * (s.slider("decay_seconds") + s.longest_step));
    checks.push(by("dye", Quantity::Colour, FLUID, rule, "what is poured out in one place until it has decayed"));
    checks.push(picture(1.02, "film is white at 1, over water of 0.034, to the power 1/1.8"));
    (checks, Some(COMPRESSIBLE))
}

pub(super) fn fluid_lit() -> Bounds {
    let mut checks = compressible("a");
    // An eddy of the jets rotates by 0.05 per unit of time on a canvas 360 high; smaller ones pass before they have a
    // visible effect. Vorticity confinement amplifies the smallest ones, the more the greater it is (the slider ends at
    // 2), up to eddies of a few cells at the speed limit: their vorticity is that speed over a cell.
    let rule = |s: &CaseConditions| {
        let dented =
            s.slider("dent") * s.slider("settle_seconds").max(s.longest_step) * f64::from(s.size.1.max(90)) / 90.0;
        let vorticity = (s.slider("confinement") / 2.0 * speed(s).high).max(0.2);
        let most = s.slider("swell") + vorticity * dented;
        Allowed::new(-most, most).unless(is_beyond_classic(s), CLASSIC)
    };
    checks.push(by("height", Quantity::Component(0), FLUID, rule, "the swell, and what an eddy dents while it lasts"));
    checks.push(by("height", Quantity::Roughness(0), FLUID, smooth, SMOOTH));
    checks.push(picture(1.0, "film is white at 1"));
    (checks, Some(COMPRESSIBLE))
}

pub(super) fn fluid_accurate() -> Bounds {
    // Without forces the energy cannot grow. Jets, mouse and lid accelerate to a given speed and no further.
    fn jets(s: &CaseConditions) -> f64 {
        if s.slider("jets") > 0.0 { s.slider("jet_speed") } else { 0.0 }
    }
    fn lid(s: &CaseConditions) -> f64 {
        if s.slider("walls") == 1.0 { s.slider("lid_speed").abs() } else { 0.0 }
    }
    fn hand(s: &CaseConditions) -> f64 {
        if s.is_dragged { 3.0 } else { 0.0 }
    }
    // A lid shears the fluid below it, and nothing in its box is faster; a tenth is added for the error of a projection
    // at the lid's corners. Where streams meet, pressure squeezes them, and the rims of eddies that roll up are faster
    // than their cause. In undisturbed runs of 2,000 frames the jets cause 2.5 times their speed. A mouse across the
    // whole picture in each frame causes 2.1 times its own, 6.26, 6.36 and 6.31 on canvases of 180, 360 and 720 rows:
    // this is a property of the flow, not of its cells.
    let speed = |s: &CaseConditions| Allowed::new(0.0, (1.15 * lid(s)).max(3.0 * jets(s)).max(2.3 * hand(s)).max(0.01));
    let energy = |s: &CaseConditions| Allowed::new(0.0, 0.5 * lid(s).max(jets(s)).max(hand(s)).powi(2).max(1e-4));
    // Jets are 0.028 heights wide, on half of the rows.
    let resolved = |s: &CaseConditions| {
        let is_sheet = s.slider("walls") == 1.0 && s.slider("viscosity") == 0.0;
        Allowed::new(0.0, 0.25)
            .unless(s.size.1 < 72, "on fewer than 72 rows a jet is narrower than a cell")
            .unless(is_sheet, "without viscosity what sticks to a wall is a sheet without thickness")
    };
    let checks = vec![
        by(
            "velocity",
            Quantity::Length(0, 1),
            Area::All,
            speed,
            "a lid makes nothing faster than itself; where streams of jets or of a hand meet, eddies turn three times as fast",
        ),
        by(
            "velocity",
            Quantity::Energy(0, 1),
            Area::All,
            energy,
            "nothing has more energy than all of it at the speed of what pushes",
        ),
        by("velocity", Quantity::Roughness(0), Area::All, resolved, SMOOTH),
        by("velocity", Quantity::Roughness(1), Area::All, resolved, SMOOTH),
        always(
            "drift",
            Quantity::Any,
            Area::All,
            (-20.0, 20.0),
            "a velocity, extrapolated by at most twice its change in a step",
        ),
        always("bottom", Quantity::Any, Area::All, (-1e3, 1e3), "a pressure times a step"),
        always("pace", Quantity::Any, Area::All, (0.0, 1.0), "a part of a step"),
        always("ledger", Quantity::Component(0), Area::All, (0.0, 3.9), "a mean of three dyes, each at most 1.3"),
        always("ledger", Quantity::Component(1), Area::All, (0.89, 1.11), "more than a tenth is not put right"),
        always("dye", Quantity::Colour, Area::All, (0.0, 1.3001), "a mean of dyes, which are poured at 1.3"),
        mouse(),
        picture(1.22, "inks are at most 1; the sun lights a fold by 1.15 and gleams by 0.25, to the power 1/1.7"),
    ];
    // The jets blow with 0.55 heights per second on half of the canvas' rows.
    let courant = Courant {
        slider: "speed",
        value: |cells, size| cells / (0.55 * 0.5 * f64::from(size.1) / 60.0),
        speed: 0,
        cells: |speed, s| speed * s.slider("speed") * s.longest_step * 0.5 * f64::from(s.size.1),
        limit: None,
    };
    (checks, Some(courant))
}

/// Returns the cases that a covering array of ends cannot contain: the box with no-slip walls and a lid is between the
/// ends of `walls`, and the viscosities at which a splitting is known to explode are between those of `viscosity`.
pub(super) fn of_fluid_accurate() -> Vec<PresetCase> {
    let mut all = Vec::new();
    for lid in [-2.0, 2.0] {
        for viscosity in [0.0, 0.01] {
            for speed in [0.0, 10.0] {
                let values = [("walls", 1.0), ("lid_speed", lid), ("viscosity", viscosity), ("speed", speed)];
                all.push(PresetCase::new(Kind::Pairs, &values));
            }
        }
    }
    // The lid, long enough for an instability to develop, at the size of a window and at twice that.
    for (size, frames) in [((640, 360), 600), ((1280, 720), 300)] {
        let values = [("walls", 1.0), ("lid_speed", 2.0), ("viscosity", 0.0), ("speed", 10.0)];
        all.push(PresetCase { large: Some((size, frames)), ..PresetCase::new(Kind::Pairs, &values) });
    }
    for viscosity in [0.0, 0.000_19, 0.000_37, 0.000_46, 0.002, 0.01] {
        for speed in [1.0, 4.0, 10.0] {
            let case = PresetCase::new(Kind::Viscosity, &[("viscosity", viscosity), ("speed", speed)]);
            all.push(PresetCase { large: Some(((1920, 1080), 60)), ..case });
        }
    }
    all
}

pub(super) fn mip_fluid() -> Bounds {
    let checks = vec![
        always(
            "velocity",
            Quantity::Length(0, 1),
            Area::All,
            (0.0, 3.0),
            "no more than 2 heights a second before the pressure, which turns and does not push",
        ),
        always(
            "velocity",
            Quantity::Energy(0, 1),
            Area::All,
            (0.0, 1.0),
            "half of the picture at the limit of speed is a storm that nothing blows",
        ),
        always("velocity", Quantity::Roughness(0), Area::All, (0.0, 0.25), SMOOTH),
        always("velocity", Quantity::Roughness(1), Area::All, (0.0, 0.25), SMOOTH),
        always(
            "measure",
            Quantity::Any,
            Area::All,
            (-1e4, 1e4),
            "a vorticity: a speed of 2 over a texel, for canvases up to 4,000 rows",
        ),
        always("paint", Quantity::Colour, Area::All, (-0.0001, 1.0001), "a mean of paints"),
        always("paint", Quantity::Component(3), Area::All, (0.0, 3.0), "a mean of speeds"),
        mouse(),
        picture(1.35, "paints are at most 0.94; light adds 22 % and a gleam of 0.3, to the power 0.8"),
    ];
    // The stirring force acts for the whole time: in 240 frames of 640 x 360 up to 0.50, 0.63, 0.73 and 0.80 heights
    // per second at a `speed` of 0.338, 0.54, 0.92 and 1.63. So `speed` is a linear function of the cells per step.
    let courant = Courant {
        slider: "speed",
        value: |cells, size| 0.15 + 1.13 * cells / (0.5 * f64::from(size.1) / 60.0),
        speed: 0,
        cells: |speed, s| speed * s.slider("speed") * s.longest_step * 0.5 * f64::from(s.size.1),
        limit: None,
    };
    (checks, Some(courant))
}

/// The pixels per frame, on a canvas 270 pixels high, by which the largest ring of self-advection moves paint, for
/// vectors of length 1.
fn leap(s: &CaseConditions) -> f64 {
    let rings = ((0.35 * f64::from(s.size.1)).ln() / s.slider("growth").ln()).floor();
    s.slider("strength") * s.slider("slope").powf(rings.clamp(0.0, (s.slider("scales") - 1.0).max(0.0))).max(1.0)
}

pub(super) fn self_advection() -> Bounds {
    const FRAYS: &str =
        "at a strength above 10, or as much by the weight of large rings, paint leaps over its eddies and frays";
    let smooth = |s: &CaseConditions| Allowed::new(0.0, 0.25).unless(leap(s) > 60.0, FRAYS);
    let checks = vec![
        always(
            "paint",
            Quantity::Length(0, 1),
            Area::All,
            (0.0, 1.6),
            "vectors grow to the length 1; noise begins with 1.54 at most",
        ),
        always(
            "paint",
            Quantity::Length(2, 3),
            Area::All,
            (0.0, 1.9),
            "as the vectors: noise and brush give 1.42 at most, and a mean no more",
        ),
        by("paint", Quantity::Roughness(0), Area::All, smooth, SMOOTH),
        by("paint", Quantity::Roughness(1), Area::All, smooth, SMOOTH),
        mouse(),
        picture(1.68, "lacquers are at most 1; light adds 16 %, a gleam 0.3 and the sky's 0.38, to the power 0.85"),
    ];
    let courant = Courant {
        slider: "strength",
        value: |cells, size| cells * 270.0 / f64::from(size.1),
        speed: 0,
        cells: |speed, s| speed * s.slider("strength") * f64::from(s.size.1) / 270.0,
        limit: None,
    };
    (checks, Some(courant))
}
