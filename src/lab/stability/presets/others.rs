//! Presets whose state is not a flow.

use super::declare::{Courant, always, by, mouse, picture};
use crate::stability::check::{Allowed, Area, CaseConditions, Check, Quantity};

pub(super) fn reaction_diffusion() -> (Vec<Check>, Option<Courant>) {
    let checks = vec![
        always("a", Quantity::Component(0), Area::All, (0.0, 1.0), "1 - u, a part of what is fed"),
        always("a", Quantity::Component(1), Area::All, (0.0, 1.0), "v: what is not fed cannot be eaten"),
        always(
            "a",
            Quantity::Roughness(0),
            Area::All,
            (0.0, 0.2),
            "a pattern is ten cells long; one of two is a step too long",
        ),
        always(
            "a",
            Quantity::Roughness(1),
            Area::All,
            (0.0, 0.2),
            "a pattern is ten cells long; one of two is a step too long",
        ),
        mouse(),
        picture(1.76, "glaze and clay are at most 1.15; light adds 65 % and a gleam of 0.55, to the power 1/1.6"),
    ];
    (checks, None)
}

const INK: &str = "ink is a mean of inks, times a strength of at most 1";

pub(super) fn mouse_state() -> Vec<Check> {
    vec![
        always("a", Quantity::Any, Area::FromRow(1), (0.0, 1.0001), INK),
        always("b", Quantity::Any, Area::ButLast, (0.0, 1.0001), INK),
        picture(1.0, "film is white at 1"),
    ]
}

pub(super) fn feedback() -> Vec<Check> {
    vec![
        always("a", Quantity::Any, Area::ButFirst, (0.0, 4.0), "a trail begins with 4 and fades"),
        picture(2.2, "four ribbons of at most 1.2 each over a ground of 0.024, as a square root"),
    ]
}

pub(super) fn spectrum() -> Vec<Check> {
    let tilted = "a byte of the analyser from 0 to 1, and up to 0.32 more for high notes; or it falls below 0 by less than a step";
    vec![
        always("a", Quantity::Component(0), Area::All, (-0.2, 1.33), tilted),
        always("a", Quantity::Component(1), Area::All, (-1.001, 1.001), "a wave of 8 bits"),
        picture(1.6, "ink of 1 on a line of 1.5, the wave beside it, to the power 1/2.2"),
    ]
}

pub(super) fn nocturne() -> Vec<Check> {
    vec![picture(1.5, "x / (1 + x / 2) is below 2, to the power 1/2.2")]
}

pub(super) fn brick_breaker() -> Vec<Check> {
    const CUT: &str = "a canvas of fewer than 16 x 7 pixels has no room for the game's state";
    // A canvas that has room for the state.
    fn room(s: &CaseConditions, low: f64, high: f64) -> Allowed {
        Allowed::new(low, high).unless(s.size.0 < 16 || s.size.1 < 7, CUT)
    }
    vec![
        by("a", Quantity::Component(0), Area::Texel(0, 0), |s| room(s, 2.38, 317.62), "the ball is between the walls"),
        by(
            "a",
            Quantity::Component(1),
            Area::Texel(0, 0),
            |s| room(s, -2.41, 159.62),
            "the ball is below the ceiling, and at most just lost",
        ),
        by(
            "a",
            Quantity::Length(2, 3),
            Area::Texel(0, 0),
            |s| room(s, 0.0, 300.1),
            "180 units a second, 15 more for each of eight levels",
        ),
        by(
            "a",
            Quantity::Component(0),
            Area::Texel(1, 0),
            |s| room(s, 21.99, 298.01),
            "the paddle is between the walls",
        ),
        by("a", Quantity::Component(1), Area::Texel(2, 0), |s| room(s, 0.0, 3.0), "lives"),
        by("a", Quantity::Component(3), Area::Texel(2, 0), |s| room(s, 0.0, 3.0), "phases of the game"),
        by("a", Quantity::Component(0), Area::Block(0, 1, 16, 6), |s| room(s, 0.0, 1.0), "a brick is whole or gone"),
        by("a", Quantity::Any, Area::Block(0, 0, 16, 7), |_| Allowed::new(-1e4, 1e7), "seconds, pixels and a score"),
        picture(
            9.3,
            "six bursts of twelve shards of at most 1.07 and a flash of 0.5, all on one pixel, over a picture of at most 6, \
             as a square root",
        ),
    ]
}

pub(super) fn particles() -> Vec<Check> {
    let lifetime = |s: &CaseConditions| Allowed::new(0.0, 14.0 * 1.4 * s.slider("lifetime") + 10.0 * s.longest_step);
    // Thrown up at 0.75 heights per second, for the longest life of a spark, from within the canvas (or its wider
    // previous size).
    let reach = |s: &CaseConditions| {
        let half_width = 0.5 * f64::from(s.size.0) / f64::from(s.size.1);
        let far = 0.75 * 3.7 * s.slider("lifetime") + half_width.max(3.0);
        Allowed::new(-far, far)
    };
    // A tile has room for 64; a streak emits 12 times its colour per second, which fades.
    let light = |s: &CaseConditions| {
        let kept = (12.0 * (s.slider("exposure_seconds") + 2.0 * s.longest_step)).max(1.0);
        Allowed::new(0.0, (64.0 * 2.6 * s.slider("brightness") * kept).max(1.0))
    };
    vec![
        by("life", Quantity::Component(0), Area::All, lifetime, "no one is older than the longest life"),
        by(
            "motion",
            Quantity::Component(0),
            Area::All,
            reach,
            "as far as a spark flies in its life, and a canvas' half width",
        ),
        by(
            "motion",
            Quantity::Component(1),
            Area::All,
            |s| Allowed::new(-0.5, 0.75 * 3.7 * s.slider("lifetime") + 3.0),
            "above the floor, and below what a spark reaches",
        ),
        always("motion", Quantity::Length(2, 3), Area::All, (0.0, 3.001), "three heights a second"),
        by(
            "light",
            Quantity::Any,
            Area::All,
            light,
            "64 particles at their brightest, for as long as the exposure lasts",
        ),
        mouse(),
        picture(1.04, "film is white at 1, over a night of 0.06, to the power 1/1.7"),
    ]
}

pub(super) fn gallery_of_tricks() -> Vec<Check> {
    const BALL: &str = "a ball is in a box of size 1";
    vec![
        always("discard", Quantity::Length(0, 1), Area::Block(0, 0, 24, 1), (0.0, 1.415), BALL),
        always("region", Quantity::Length(0, 1), Area::Block(0, 0, 24, 1), (0.0, 1.415), BALL),
        always("discard", Quantity::Any, Area::All, (-1.0, 1.0), "lines that are at most white, and balls"),
        always("region", Quantity::Any, Area::Block(0, 0, 24, 1), (-1.0, 1.0), BALL),
        always(
            "waves",
            Quantity::Component(0),
            Area::All,
            (-3.0, 3.0),
            "a drop of height 1 each 150 frames; six of them in a box that rings",
        ),
        always("waves", Quantity::Component(1), Area::All, (-3.0, 3.0), "a change a frame is less than a height"),
        always("noise", Quantity::Component(0), Area::All, (-1.0, 1.0), "a hyperbolic tangent, mixed"),
        always(
            "progress",
            Quantity::Any,
            Area::All,
            (0.0, 8.0),
            "octaves that sum to less than 1, and how many of eight there are",
        ),
        picture(3.61, "24 rings of half a white each, all on one pixel, over a picture of at most 1, as a square root"),
    ]
}

pub(super) fn taa() -> Vec<Check> {
    vec![
        always("b", Quantity::Colour, Area::All, (0.0, 1.0001), "a screen has no more than 1"),
        always("b", Quantity::Component(3), Area::All, (0.0, 255.0), "an age in frames"),
        always("c", Quantity::Any, Area::All, (-1e4, 1e5), "an object's number and the time of a frame"),
        picture(1.0, "a screen has no more than 1"),
    ]
}

pub(super) fn scene_bloom_taa() -> Vec<Check> {
    let light = |s: &CaseConditions| Allowed::new(0.0, 8.0 + 4.0 * s.slider("lamps"));
    vec![
        by(
            "b",
            Quantity::Colour,
            Area::All,
            light,
            "the lamps' radiance, four times over where two lamps and their mirror images meet",
        ),
        always("b", Quantity::Component(3), Area::All, (0.0, 255.0), "an age in frames"),
        always("c", Quantity::Component(0), Area::All, (0.0, 60.0), "a distance; a ray that hits nothing ends at 60"),
        always("c", Quantity::Component(1), Area::All, (0.0, 1e5), "one more than the seconds of a frame"),
        picture(1.0, "a screen has no more than 1"),
    ]
}

pub(super) fn ssao() -> Vec<Check> {
    vec![
        always("mode", Quantity::Component(0), Area::All, (0.0, 2.0), "which of three pictures is shown"),
        picture(1.0, "a screen has no more than 1"),
    ]
}
