//! The ball of a brick-breaking game compared with one that is computed in fractions.

use crate::{
    HardCase, LabError, Measured, Method, Point, Rig, Running, Setup, Study, Unit, metrics::Norms,
    reference::billiard::Billiard,
};

/// Units per frame; the preset's ball moves by 3 in its first level.
const SPEEDS: &[f64] = &[1.0, 3.0, 10.0, 30.0, 100.0, 300.0];

const METHODS: &[Method] = &[
    Method { name: "preset", title: "the preset brick-breaker, swept", settings: SPEEDS, usual: 3.0 },
    Method { name: "overlap", title: "tested for overlap", settings: SPEEDS, usual: 3.0 },
    Method { name: "overlap-16", title: "tested for overlap, 16 times a frame", settings: SPEEDS, usual: 3.0 },
];

/// The length of the path in units.
const PATH: f64 = 1200.0;
/// The initial direction of the ball, relative to the vertical.
const ANGLE: f64 = 0.42;
const COLUMNS: usize = 16;
const ROWS: usize = 6;
/// The grid of the preset's positions.
const TICKS: f64 = 32768.0;
/// Units per frame of the long flight without bricks.
const FASTEST: f64 = 1e4;

fn ticks(units: f64) -> i64 {
    (units * TICKS).round_ties_even() as i64
}

fn velocity(speed: f64) -> [f32; 2] {
    [ANGLE.sin(), ANGLE.cos()].map(|along| (60.0 * speed * along) as f32)
}

/// Returns the preset without its paddle, over a floor that reflects, with the ball at a speed.
fn practice(side: u32, speed: f64) -> Setup {
    let [u, v] = velocity(speed);
    Setup::new("brick-breaker", (side, side))
        .wants(&["a"])
        .edit("a", "SOLID_FLOOR = false", "SOLID_FLOOR = true")
        .edit("a", "launch(0.42);", format!("velocity = vec2({u:?}, {v:?});"))
        .edit("a", "<= PADDLE_HALF.x + BALL_RADIUS", "< -1.0")
}

fn is_preset(name: &str) -> bool {
    name == "preset"
}

fn playing(name: &str, side: u32, speed: f64) -> Setup {
    if is_preset(name) {
        return practice(side, speed);
    }
    Setup::new("brick_overlap", (side, side)).uniforms("way", &peers_way(name, speed)).steps("solver", steps_of(name))
}

fn steps_of(name: &str) -> u32 {
    if name == "overlap" { 1 } else { 16 }
}

/// Returns the displacement per step, as in the shader.
fn peers_way(name: &str, speed: f64) -> [f64; 2] {
    [ANGLE.sin(), ANGLE.cos()].map(|along| f64::from((speed / f64::from(steps_of(name)) * along) as f32))
}

/// The state of a game: position, velocity, and the remaining bricks.
#[derive(Clone, Debug, PartialEq)]
pub struct Seen {
    pub at: [f64; 2],
    pub velocity: [f64; 2],
    pub bricks: Vec<bool>,
}

fn seen(running: &mut Running, name: &str) -> Result<Seen, LabError> {
    let field = running.read(if is_preset(name) { "a" } else { "field" })?;
    let width = field.width();
    let [x, y, u, v] = field.texels()[0].map(f64::from);
    let brick = |i: usize| field.texels()[(1 + i / COLUMNS) * width + i % COLUMNS][0] > 0.5;
    Ok(Seen { at: [x, y], velocity: [u, v], bricks: (0..COLUMNS * ROWS).map(brick).collect() })
}

fn centre(index: usize) -> [i64; 2] {
    let at = |n: usize, size: f64, low: f64| ticks((n as f64 + 0.5) * size + low);
    [at(index % COLUMNS, 20.0, 0.0), at(index / COLUMNS, 9.0, 92.0)]
}

/// Returns the exact ball: its start, on the preset's grid, and the displacement per frame.
fn exact(at: [f64; 2], speed: f64, bricks: bool) -> Billiard {
    // The only rounding in the definition of the game: the displacement per frame from a 32-bit velocity and a 32-bit
    // step.
    let way = velocity(speed).map(|v| ticks(f64::from(v * (1.0f32 / 60.0))));
    Billiard {
        low: [ticks(2.4); 2],
        high: [ticks(317.6), ticks(159.6)],
        bricks: if bricks { (0..COLUMNS * ROWS).map(centre).collect() } else { Vec::new() },
        half: [ticks(11.6), ticks(6.1)],
        at: at.map(ticks),
        way,
    }
}

/// A game compared with the exact one.
#[derive(Clone, Debug, Default)]
pub struct Played {
    pub norms: Norms,
    /// The number of bricks that remain in only one of the games at the end.
    pub bricks_wrong: usize,
    pub bricks_hit: usize,
    /// The number of frames in which a brick reappeared.
    pub came_back: usize,
    /// The distance in units by which the ball was beyond a wall.
    pub outside: f64,
    /// The change of a component's absolute value, relative to the speed.
    pub speed_drift: f64,
    /// The largest distance between the two balls, in units.
    pub off: f64,
}

/// Plays `frames` at `speed` units per frame.
pub fn played(rig: &Rig, name: &str, side: u32, speed: f64, frames: u32) -> Result<Played, LabError> {
    let mut running = rig.open(&playing(name, side, speed))?;
    let start = if is_preset(name) {
        // Its first frame initialises the game.
        running.frames(1)?;
        seen(&mut running, name)?
    } else {
        Seen { at: [160.0, 17.0], velocity: peers_way(name, speed), bricks: vec![true; COLUMNS * ROWS] }
    };
    let mut oracle = exact(start.at, speed, true);
    let (mut measured, mut expected) = (Vec::new(), Vec::new());
    let mut result = Played::default();
    let mut before = start.bricks.clone();
    let [low, high] = [[2.4; 2], [317.6, 159.6]];
    for _ in 0..frames {
        running.frames(1)?;
        let now = seen(&mut running, name)?;
        result.bricks_hit += oracle.step().len();
        let at = oracle.at.map(|x| x as f64 / TICKS);
        result.came_back += usize::from(before.iter().zip(&now.bricks).any(|(a, b)| *b && !*a));
        for k in 0..2 {
            let outside = (low[k] - now.at[k]).max(now.at[k] - high[k]).max(0.0);
            result.outside = result.outside.max(if outside.is_nan() { f64::INFINITY } else { outside });
            let drift = (now.velocity[k].abs() / start.velocity[k].abs() - 1.0).abs();
            result.speed_drift = result.speed_drift.max(drift);
            result.off = result.off.max((now.at[k] - at[k]).abs());
        }
        measured.extend(now.at);
        expected.extend(at);
        before = now.bricks;
    }
    let remains = |i: usize| oracle.bricks.contains(&centre(i));
    result.bricks_wrong = (0..COLUMNS * ROWS).filter(|&i| remains(i) != before[i]).count();
    result.norms = Norms::of(&measured, &expected);
    Ok(result)
}

/// Returns the flight of the preset's ball without bricks at 10,000 units per frame: (bounces, maximum distance in
/// units from the unfolded path).
pub fn unfolded(rig: &Rig, side: u32, frames: u32) -> Result<(f64, f64), LabError> {
    let setup = practice(side, FASTEST).edit("a", "if (brickInLevel(c, r, level))", "if (c < 0)");
    let mut running = rig.open(&setup)?;
    running.frames(1)?;
    let start = seen(&mut running, "preset")?;
    let oracle = exact(start.at, FASTEST, false);
    let mut off = 0.0f64;
    for part in 1..=4 {
        running.frames(frames / 4)?;
        let now = seen(&mut running, "preset")?;
        for k in 0..2 {
            let length = oracle.high[k] - oracle.low[k];
            let along = oracle.at[k] + i64::from(part * (frames / 4)) * oracle.way[k] - oracle.low[k];
            let folded = oracle.high[k] - (length - along.rem_euclid(2 * length)).abs();
            off = off.max((now.at[k] - folded as f64 / TICKS).abs());
        }
    }
    let way = |k: usize| (oracle.way[k] as f64 / (oracle.high[k] - oracle.low[k]) as f64).abs();
    Ok((f64::from(frames / 4 * 4) * (way(0) + way(1)), off))
}

pub static STUDY: Study = Study {
    name: "brick-breaker",
    title: "Brick breaker",
    text: "A ball flies 1,200 units among 96 bricks and four walls, at 1 to 300 units a frame; the bricks are \
           18.4 x 7.4. The reference is event-driven and computed in fractions, so that nothing is rounded \
           but the way of a frame, to 2^-15 units. The error is that of the ball's place in all frames; half \
           of 2^-15 units is added, as no place is known closer. The preset finds the time of each impact; \
           its peers move the ball and look what it overlaps. The hard cases: the same bricks are broken, no \
           brick comes back, the ball stays within the walls, its velocity changes sign and nothing else; and \
           for the preset, at its usual setting, that at 10,000 units a frame it is within .001 units of the \
           unfolded path after 10,000 bounces.",
    parameter: "units a frame",
    unit: Unit::Scene,
    error: "of the ball's place",
    methods: METHODS,
    grids: [[16, 32, 64]; 2],
    // The state has a fixed size.
    main_grid: Some(16),
    has_order: false,
    ..Study::of(|point| playing(&point.method, point.grid, point.setting), measure)
};

fn measure(rig: &Rig, point: &Point) -> Result<Measured, LabError> {
    let frames = (PATH / point.setting).round();
    let game = played(rig, &point.method, point.grid, point.setting, frames as u32)?;
    let mut norms = game.norms;
    let half_tick = 0.5 / TICKS / 160.0;
    (norms.l1, norms.l2, norms.linf) = (norms.l1 + half_tick, norms.l2 + half_tick, norms.linf + half_tick);
    let mut measured = Measured { norms, frames_per_unit: frames, ..Measured::default() }
        .value("bricks_hit", game.bricks_hit as f64)
        .value("bricks_wrong", game.bricks_wrong as f64)
        .value("units_off", game.off)
        .hard(HardCase::at_most("bricks unlike the exact game's", game.bricks_wrong as f64, 0.0))
        .hard(HardCase::at_most("bricks that come back", game.came_back as f64, 0.0))
        .hard(HardCase::at_most("units beyond a wall", game.outside, 1e-4))
        .hard(HardCase::at_most("change of speed", game.speed_drift, 0.0));
    if is_preset(&point.method) && point.setting == METHODS[0].usual {
        let (bounces, off) = unfolded(rig, point.grid, 144)?;
        measured = measured.value("unfolded_bounces", bounces).value("unfolded_off", off);
        measured = measured.hard(HardCase::at_most("units off the unfolded path", off, 1e-3));
    }
    Ok(measured)
}
