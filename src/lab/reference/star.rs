//! A Siemens star, a hairline and a moving disc, sampled at any resolution.

use eddy_metrics::picture::Picture;
use std::ops::RangeInclusive;

/// The side of the canvas in pixels.
pub const SIDE: usize = 192;

/// The pixels per frame by which the disc moves to the right: fast, and so slow that its edge stays in a pixel for
/// three frames.
pub const SPEED: f64 = 2.37;
pub const SLOW: f64 = 0.35;

const RADIUS: f64 = 20.0;
pub const DISC: [f64; 3] = [0.95, 0.90, 0.80];

/// The scene in a frame; `None` for no disc.
#[derive(Clone, Copy, Debug)]
pub struct Star {
    pub frame: Option<u32>,
    /// The pixels per frame by which the disc moves.
    pub speed: f64,
}

impl Star {
    /// The scene without the disc.
    pub const STILL: Star = Star { frame: None, speed: SPEED };

    /// Returns the position of the disc's centre, in pixels from the centre of the canvas.
    fn disc(frame: u32, speed: f64) -> [f64; 2] {
        [-60.0 + speed * f64::from(frame), -20.0]
    }

    fn is_disc((frame, speed): (u32, f64), [x, y]: [f64; 2]) -> bool {
        let [cx, cy] = Star::disc(frame, speed);
        (x - cx).powi(2) + (y - cy).powi(2) < RADIUS * RADIUS
    }

    /// Returns the colour at a place, in pixels from the centre of the canvas.
    fn colour(self, [x, y]: [f64; 2]) -> [f64; 3] {
        if self.frame.is_some_and(|frame| Star::is_disc((frame, self.speed), [x, y])) {
            return DISC;
        }
        // 72 rays of a 144th of the circle each, 90 pixels long; a line of one pixel's width.
        let sector = (y.atan2(x) / std::f64::consts::PI * 72.0).floor();
        let is_ray = sector.rem_euclid(2.0) < 1.0 && x * x + y * y < 90.0 * 90.0;
        let is_hair = (y - 0.3 * x - 82.56).abs() / 1.0f64.hypot(0.3) < 0.5;
        [if is_ray || is_hair { 0.64 } else { 0.36 }; 3]
    }

    /// Returns the mean of 8 x 8 samples in each pixel.
    pub fn picture(self) -> Picture {
        let middle = SIDE as f64 / 2.0;
        let pixel = |i: usize| {
            let (x, y) = ((i % SIDE) as f64 - middle, (i / SIDE) as f64 - middle);
            let mut sum = [0.0; 3];
            for j in 0..64 {
                let at = [x + (f64::from(j % 8) + 0.5) / 8.0, y + (f64::from(j / 8) + 0.5) / 8.0];
                let colour = self.colour(at);
                (0..3).for_each(|c| sum[c] += colour[c] / 64.0);
            }
            sum
        };
        Picture::new(SIDE, (0..SIDE * SIDE).map(pixel).collect())
    }

    /// Returns the pixels that a disc of this speed covered completely at `frame` and touched in none of the frames
    /// `since`.
    pub fn vacated(speed: f64, frame: u32, since: RangeInclusive<u32>) -> Vec<usize> {
        // Rows that the disc never reaches are skipped.
        let middle = SIDE as f64 / 2.0;
        let rows = (middle - 20.0 - RADIUS) as usize - 1..(middle - 20.0 + RADIUS) as usize + 2;
        (rows.start * SIDE..rows.end * SIDE)
            .filter(|&i| {
                let is_covered = corners(i).iter().all(|p| Star::is_disc((frame, speed), *p));
                is_covered && !Star::touches(speed, since.clone(), i)
            })
            .collect()
    }

    /// Returns the pixels that a disc of this speed covered completely earlier, touched in frame `frame - ago`, and has
    /// not touched since.
    pub fn left_ago(speed: f64, frame: u32, ago: u32) -> Vec<usize> {
        let last = frame - ago;
        // The number of frames in which the edge crosses a pixel's diagonal.
        let crosses = (2f64.sqrt() / speed).ceil() as u32;
        let gone = Star::vacated(speed, last - crosses, last + 1..=frame);
        gone.into_iter().filter(|i| Star::touches(speed, last..=last, *i)).collect()
    }

    fn touches(speed: f64, mut frames: RangeInclusive<u32>, i: usize) -> bool {
        frames.any(|frame| corners(i).iter().any(|p| Star::is_disc((frame, speed), *p)))
    }
}

/// Returns the corners of a pixel, relative to the centre of the canvas.
fn corners(i: usize) -> [[f64; 2]; 4] {
    let middle = SIDE as f64 / 2.0;
    [0, 1, 2, 3].map(|c| [((i % SIDE) + c % 2) as f64 - middle, ((i / SIDE) + c / 2) as f64 - middle])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_star_is_white_and_the_disc_has_its_area() {
        let still = Star::STILL.picture();
        let middle = SIDE as f64 / 2.0;
        let (mut sum, mut n) = (0.0, 0.0);
        for (i, c) in still.rgb.iter().enumerate() {
            let (x, y) = ((i % SIDE) as f64 + 0.5 - middle, (i / SIDE) as f64 + 0.5 - middle);
            if x.hypot(y) < 70.0 {
                (sum, n) = (sum + c[0], n + 1.0);
            }
        }
        assert!((sum / n - 0.5).abs() < 2e-3, "{}", sum / n);
        let moved = Star { frame: Some(20), speed: SPEED }.picture();
        let blue = moved.rgb.iter().filter(|c| (c[0] - DISC[0]).abs() < 1e-9 && (c[2] - DISC[2]).abs() < 1e-9).count();
        let area = std::f64::consts::PI * RADIUS * RADIUS;
        assert!((blue as f64) < area && blue as f64 > 0.88 * area, "{blue}");
    }

    #[test]
    fn vacated_pixels_are_behind_the_disc() {
        let all = Star::vacated(SPEED, 34, 40..=40);
        let right = Star::disc(40, SPEED)[0] - RADIUS * 0.2 + SIDE as f64 / 2.0;
        assert!(all.len() > 300 && all.iter().all(|i| ((i % SIDE) as f64) < right), "{}", all.len());
        // A strip that one frame uncovers.
        let strip = Star::vacated(SPEED, 34, 35..=40);
        assert!(strip.len() > 10 && strip.len() < all.len() / 3 && strip.iter().all(|i| all.contains(i)));
        // A slow disc uncovered only a thin strip behind it four frames ago.
        let slow = Star::left_ago(SLOW, 40, 4);
        let back = |i: &usize| Star::disc(40, SLOW)[0] + SIDE as f64 / 2.0 - (i % SIDE) as f64;
        assert!(
            slow.len() > 5 && slow.len() < 60 && slow.iter().all(|i| back(i) > 0.0 && back(i) < RADIUS + 4.0),
            "{slow:?}"
        );
    }
}
