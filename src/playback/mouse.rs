//! `iMouse` over time, as defined in section 5 of `shadertoy.md`.

/// The mouse's state between frames. Points are canvas pixels from the bottom left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mouse {
    at: [f32; 2],
    pressed_at: [f32; 2],
    is_down: bool,
    /// No frame has been rendered since the press.
    is_fresh: bool,
    /// The sum of all drags.
    dragged: [f32; 2],
    /// The position of the pointer, whether or not the button is down; `None` before it first moves.
    pointer: Option<[f32; 2]>,
}

impl Mouse {
    pub fn press(&mut self, x: f32, y: f32) {
        self.at = whole(x, y);
        self.pointer = Some(self.at);
        self.pressed_at = self.at;
        self.is_down = true;
        self.is_fresh = true;
    }

    /// Moves the pointer, and while the button is down Shadertoy's mouse.
    pub fn move_to(&mut self, x: f32, y: f32) {
        let to = whole(x, y);
        self.pointer = Some(to);
        if self.is_down {
            for (sum, (to, from)) in self.dragged.iter_mut().zip(to.into_iter().zip(self.at)) {
                *sum += to - from;
            }
            self.at = to;
        }
    }

    pub fn release(&mut self) {
        self.is_down = false;
    }

    /// Continues from the state of a recorded mouse, with the button released.
    pub fn follow(&mut self, imouse: [f32; 4], dragged: [f32; 2], pointer: Option<[f32; 2]>) {
        let [x, y, z, w] = imouse;
        *self = Self { at: [x, y], pressed_at: [z.abs(), w.abs()], is_down: false, is_fresh: false, dragged, pointer };
    }

    /// Returns the position of the pointer, in whole pixels from the bottom left; `None` before it first moves.
    pub fn pointer(&self) -> Option<[f32; 2]> {
        self.pointer
    }

    pub fn is_down(&self) -> bool {
        self.is_down
    }

    /// Returns the total distance dragged, to the right and up.
    pub fn dragged(&self) -> [f32; 2] {
        self.dragged
    }

    /// Returns `iMouse` of the frame that is drawn now, which consumes the press. A press that was released before any
    /// frame appears in w alone, as on Shadertoy.
    pub fn next_frame(&mut self) -> [f32; 4] {
        let sign = |positive, v: f32| if positive { v.abs() } else { -v.abs() };
        let z = sign(self.is_down, self.pressed_at[0]);
        let w = sign(std::mem::take(&mut self.is_fresh), self.pressed_at[1]);
        [self.at[0], self.at[1], z, w]
    }
}

/// Shadertoy counts whole pixels from the bottom left; a non-finite coordinate becomes 0.
fn whole(x: f32, y: f32) -> [f32; 2] {
    [x, y].map(|v| if v.is_finite() { v.floor() } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares bits, because 0.0 and -0.0 are equal but differ in sign.
    fn bits(v: [f32; 4]) -> [u32; 4] {
        v.map(f32::to_bits)
    }

    #[test]
    fn matches_the_table_of_shadertoy() {
        let mut m = Mouse::default();
        assert_eq!(bits(m.next_frame()), bits([0.0, 0.0, -0.0, -0.0]), "never clicked");
        m.move_to(5.0, 6.0);
        assert_eq!(bits(m.next_frame()), bits([0.0, 0.0, -0.0, -0.0]), "moves count only while down");
        m.press(40.9, 30.2);
        assert_eq!(m.next_frame(), [40.0, 30.0, 40.0, 30.0], "first frame of a press");
        assert_eq!(m.next_frame(), [40.0, 30.0, 40.0, -30.0], "held");
        m.move_to(80.5, 45.99);
        assert_eq!(m.next_frame(), [80.0, 45.0, 40.0, -30.0], "dragged");
        m.release();
        m.move_to(1.0, 1.0);
        assert_eq!(m.next_frame(), [80.0, 45.0, -40.0, -30.0], "released");
    }

    #[test]
    fn drags_add_up_and_presses_do_not_jump() {
        let mut m = Mouse::default();
        m.move_to(50.0, 50.0);
        m.press(10.0, 10.0);
        m.move_to(30.0, 5.0);
        m.release();
        m.move_to(99.0, 99.0);
        m.press(0.0, 0.0);
        assert_eq!(m.dragged(), [20.0, -5.0]);
        m.move_to(1.0, 1.0);
        assert_eq!(m.dragged(), [21.0, -4.0]);
    }

    #[test]
    fn a_press_at_the_edge_has_no_sign_to_see() {
        let mut m = Mouse::default();
        m.press(0.4, 0.0);
        assert_eq!(bits(m.next_frame()), bits([0.0; 4]));
        assert_eq!(bits(m.next_frame()), bits([0.0, 0.0, 0.0, -0.0]));
    }

    #[test]
    fn a_click_between_two_frames_shows_in_w_alone() {
        let mut m = Mouse::default();
        m.press(7.0, 9.0);
        m.release();
        assert_eq!(m.next_frame(), [7.0, 9.0, -7.0, 9.0]);
        assert_eq!(m.next_frame(), [7.0, 9.0, -7.0, -9.0]);
    }

    #[test]
    fn a_drag_out_of_the_picture_goes_below_zero_and_never_to_nan() {
        let mut m = Mouse::default();
        m.press(3.0, 3.0);
        m.move_to(-0.5, f32::NAN);
        assert_eq!(m.next_frame(), [-1.0, 0.0, 3.0, 3.0]);
    }
}
