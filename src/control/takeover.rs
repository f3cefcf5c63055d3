//! Soft takeover: a knob whose position differs from the value takes control when it passes the value.
//!
//! A knob keeps its position, but the value is also changed by the mouse, by undo and by opening a project. If the knob
//! always set the value, the value would jump. So until the knob reaches the value, its movements are only recorded.
//! Musical keyboards and mixers call this soft takeover or pickup.

/// The side of the value on which a knob is that does not control it yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PickupSide {
    /// The knob has to be turned up.
    Below,
    /// The knob has to be turned down.
    Above,
}

/// A movement of a knob, and the value that it should set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// The position of the knob, from 0 to 1.
    pub knob: f64,
    /// The position of the value in the range of its slider, from 0 to 1.
    pub slider: f64,
    /// The current value, in units of the slider.
    pub value: f64,
    /// The value at the knob's position.
    pub target: f64,
}

/// The state of a knob and its value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Takeover {
    /// The previous position of the knob.
    knob: Option<f64>,
    /// The value that the knob has set. If it differs from the current one, something else has changed it.
    held: Option<f64>,
    waits: Option<PickupSide>,
    /// The next movement takes control wherever the knob is.
    is_learned: bool,
}

/// The distance within which a knob of 7 bits has reached the value: one step. A fast turn may skip steps, but it
/// passes the value.
const NEAR: f64 = 1.0 / 127.0;

impl Takeover {
    /// Creates the state of a knob that was just assigned to the value: it takes control at once.
    pub fn learned() -> Self {
        Self { is_learned: true, ..Self::default() }
    }

    /// Returns the side on which the knob waits, as of its last movement. `None` if it controls the value.
    pub fn waits(&self) -> Option<PickupSide> {
        self.waits
    }

    /// Takes a movement of the knob. Returns whether it sets the value.
    pub fn moves(&mut self, movement: Movement) -> bool {
        let Movement { knob, slider, value, target } = movement;
        let before = self.knob.replace(knob);
        let is_held = self.held.is_some_and(|held| held == value);
        let has_passed = before.is_some_and(|before| (before - slider) * (knob - slider) <= 0.0);
        let is_there = target == value || (knob - slider).abs() <= NEAR;
        if std::mem::take(&mut self.is_learned) || is_held || has_passed || is_there {
            (self.held, self.waits) = (Some(target), None);
            return true;
        }
        (self.held, self.waits) = (None, Some(if knob < slider { PickupSide::Below } else { PickupSide::Above }));
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slider from 0 to 1 and a knob of 7 bits.
    struct Slider {
        value: f64,
        takeover: Takeover,
    }

    impl Slider {
        fn at(value: f64) -> Self {
            Self { value, takeover: Takeover::default() }
        }

        fn turn(&mut self, step: u8) -> (f64, Option<PickupSide>) {
            let knob = f64::from(step) / 127.0;
            let movement = Movement { knob, slider: self.value, value: self.value, target: knob };
            if self.takeover.moves(movement) {
                self.value = knob;
            }
            (self.value, self.takeover.waits())
        }
    }

    #[test]
    fn a_knob_takes_over_where_it_passes_the_value() {
        let mut slider = Slider::at(0.5);
        assert_eq!(slider.turn(10), (0.5, Some(PickupSide::Below)));
        assert_eq!(slider.turn(40), (0.5, Some(PickupSide::Below)));
        assert_eq!(slider.turn(100), (100.0 / 127.0, None), "a fast turn over the value");
        assert_eq!(slider.turn(3), (3.0 / 127.0, None), "and from then on every movement");
        // From above, step by step.
        let mut slider = Slider::at(0.5);
        assert_eq!(slider.turn(70), (0.5, Some(PickupSide::Above)));
        for step in (66..70).rev() {
            assert_eq!(slider.turn(step), (0.5, Some(PickupSide::Above)), "{step}");
        }
        assert_eq!(slider.turn(64), (64.0 / 127.0, None), "one step away");
    }

    #[test]
    fn a_knob_waits_again_after_something_else_changed_the_value() {
        let mut slider = Slider { value: 0.25, takeover: Takeover::learned() };
        assert_eq!(slider.turn(127), (1.0, None), "a hand has just chosen it");
        slider.value = 0.25;
        assert_eq!(slider.turn(126), (0.25, Some(PickupSide::Above)));
        assert_eq!(slider.turn(0), (0.0, None));
        // An end of the range is reached.
        let mut slider = Slider::at(1.0);
        assert_eq!(slider.turn(90).1, Some(PickupSide::Below));
        assert_eq!(slider.turn(127), (1.0, None));
        assert_eq!(slider.turn(100), (100.0 / 127.0, None));
    }

    #[test]
    fn integer_values_are_matched_after_rounding() {
        let mut takeover = Takeover::default();
        let at = |knob: f64| Movement { knob, slider: 0.5, value: 5.0, target: (1.0 + 8.0 * knob).round() };
        assert!(!takeover.moves(at(0.2)));
        assert!(takeover.moves(at(0.45)), "it stands for 5 as well");
    }
}
