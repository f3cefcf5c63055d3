//! The mouse and the clock in a case, frame by frame. Nothing is random: the same case has the same inputs.

use eddy_engine::FrameInputs;

/// The rate of the default time step.
const FRAMES_A_SECOND: f64 = 60.0;

/// The movement of the mouse during a disturbance. It is pressed in its first frame and released in the first frame
/// after it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MouseGesture {
    #[default]
    Away,
    /// Half of the canvas, in one uniform stroke.
    Slow,
    /// Back and forth across most of the canvas, eight frames each way.
    Fast,
    /// Pulled past the left edge and held there, moving along it.
    Edge,
    /// To another corner in each frame: across the whole picture in one frame.
    Across,
}

impl MouseGesture {
    pub const DRAGS: [(MouseGesture, &'static str); 4] = [
        (MouseGesture::Slow, "slow drag"),
        (MouseGesture::Fast, "fast drag"),
        (MouseGesture::Edge, "drag held at an edge"),
        (MouseGesture::Across, "drag across the whole picture in a frame"),
    ];

    /// Returns the position of the mouse `t` frames after the press in a drag of `frames`, in whole canvas pixels from
    /// the bottom left.
    fn at(self, t: u32, frames: u32, size: (u32, u32)) -> [f32; 2] {
        let (w, h) = (f64::from(size.0), f64::from(size.1));
        let part = f64::from(t) / f64::from(frames.max(1));
        let (x, y) = match self {
            MouseGesture::Away => (0.0, 0.0),
            MouseGesture::Slow => (w * (0.25 + 0.5 * part), h * (0.5 + 0.1 * (6.0 * part).sin())),
            MouseGesture::Fast => {
                let there = f64::from(t % 16) / 8.0;
                (w * (0.1 + 0.8 * there.min(2.0 - there)), h * (0.2 + 0.6 * part))
            }
            MouseGesture::Edge => (w * (0.2 - 0.03 * f64::from(t)).max(-0.1), h * (0.5 + 0.45 * (12.0 * part).sin())),
            MouseGesture::Across => match t % 4 {
                0 => (1.0, 1.0),
                1 => (w - 2.0, h - 2.0),
                2 => (1.0, h - 2.0),
                _ => (w - 2.0, 1.0),
            },
        };
        [x.floor() as f32, y.floor() as f32]
    }
}

/// The duration of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Steps {
    /// A sixtieth of a second.
    #[default]
    Usual,
    /// Multiples of that, during the disturbance.
    Times(f64),
    /// Frames of the disturbance take this number of seconds, as when a program was suspended for that long.
    Seconds(f64),
    /// No time passes during the disturbance: frames drawn during a pause.
    Still,
    /// Varying from a 240th to a 15th of a second, during the disturbance.
    Uneven,
}

impl Steps {
    /// Returns the seconds of a frame, `t` frames after the disturbance started; `t` is `None` outside of it.
    fn seconds(self, t: Option<u32>) -> f64 {
        let usual = 1.0 / FRAMES_A_SECOND;
        let Some(t) = t else { return usual };
        match self {
            Steps::Usual => usual,
            Steps::Times(factor) => factor * usual,
            Steps::Seconds(seconds) => seconds,
            Steps::Still => 0.0,
            Steps::Uneven => usual * [0.25, 4.0, 1.0, 2.0, 0.5][t as usize % 5],
        }
    }

    pub fn longest(self) -> f64 {
        (0..5).map(|t| self.seconds(Some(t))).fold(1.0 / FRAMES_A_SECOND, f64::max)
    }
}

/// The inputs of consecutive frames.
pub(super) struct Inputs {
    hand: MouseGesture,
    steps: Steps,
    /// The frames from the first to before the last.
    disturbed: Option<(u32, u32)>,
    frame: u32,
    seconds: f64,
    mouse: [f32; 4],
    drag: [f32; 2],
}

impl Inputs {
    pub(super) fn new(hand: MouseGesture, steps: Steps, disturbed: Option<(u32, u32)>) -> Inputs {
        Inputs { hand, steps, disturbed, frame: 0, seconds: 0.0, mouse: [0.0, 0.0, -0.0, -0.0], drag: [0.0; 2] }
    }

    /// Returns the inputs of the next frame, on a canvas of this size.
    pub(super) fn next(&mut self, size: (u32, u32)) -> FrameInputs {
        let since = self.disturbed.filter(|(from, to)| (*from..*to).contains(&self.frame));
        let t = since.map(|(from, _)| self.frame - from);
        let delta = self.steps.seconds(t);
        match (t, since) {
            (Some(t), Some((from, to))) if self.hand != MouseGesture::Away => {
                let [x, y] = self.hand.at(t, to - from, size);
                if t > 0 {
                    self.drag = [self.drag[0] + x - self.mouse[0], self.drag[1] + y - self.mouse[1]];
                } else {
                    (self.mouse[2], self.mouse[3]) = (x.abs(), y.abs());
                }
                (self.mouse[0], self.mouse[1]) = (x, y);
                if t > 0 {
                    self.mouse[3] = -self.mouse[3].abs();
                }
            }
            _ => (self.mouse[2], self.mouse[3]) = (-self.mouse[2].abs(), -self.mouse[3].abs()),
        }
        // As in the window: `iTime` is the time at the start of the frame.
        let inputs = FrameInputs {
            frame: self.frame as i32,
            time_secs: self.seconds,
            time_delta_secs: delta as f32,
            frame_rate: if delta > 0.0 { (1.0 / delta) as f32 } else { FRAMES_A_SECOND as f32 },
            mouse: self.mouse,
            drag: self.drag,
            ..FrameInputs::at_fixed_step(self.frame as i32, FRAMES_A_SECOND)
        };
        self.frame += 1;
        self.seconds += self
            .steps
            .seconds(self.disturbed.filter(|(a, b)| (*a..*b).contains(&self.frame)).map(|(a, _)| self.frame - a));
        inputs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_pressed_once_held_and_released() {
        let mut inputs = Inputs::new(MouseGesture::Across, Steps::Usual, Some((2, 5)));
        let mice: Vec<[f32; 4]> = (0..7).map(|_| inputs.next((64, 36)).mouse).collect();
        assert_eq!(mice[2], [1.0, 1.0, 1.0, 1.0]);
        assert_eq!(mice[3], [62.0, 34.0, 1.0, -1.0], "across in one frame");
        assert_eq!(mice[4], [1.0, 34.0, 1.0, -1.0]);
        assert_eq!(mice[5], [1.0, 34.0, -1.0, -1.0]);
        assert!(mice[1][2].is_sign_negative() && mice[0][2] == 0.0);
        assert_eq!(mice[6], mice[5]);
    }

    #[test]
    fn a_held_drag_goes_past_the_edge() {
        let size = (640, 360);
        assert!(MouseGesture::Edge.at(60, 60, size)[0] < 0.0);
        let far = |hand: MouseGesture| {
            (1..60).map(|t| (hand.at(t, 60, size)[0] - hand.at(t - 1, 60, size)[0]).abs()).fold(0.0, f32::max)
        };
        assert!(far(MouseGesture::Slow) < 7.0 && far(MouseGesture::Fast) > 50.0 && far(MouseGesture::Across) > 600.0);
    }

    #[test]
    fn time_is_the_sum_of_its_steps() {
        for steps in [Steps::Usual, Steps::Times(10.0), Steps::Seconds(0.25), Steps::Still, Steps::Uneven] {
            let mut inputs = Inputs::new(MouseGesture::Away, steps, Some((3, 9)));
            let (mut before, mut most) = (inputs.next((8, 8)).time_secs, 0.0f64);
            for _ in 1..20 {
                let now = inputs.next((8, 8));
                assert!((now.time_secs - before - f64::from(now.time_delta_secs)).abs() < 1e-6, "{steps:?}");
                before = now.time_secs;
                most = most.max(f64::from(now.time_delta_secs));
            }
            assert!((most - steps.longest()).abs() < 1e-6, "{steps:?}");
        }
    }
}
