//! A ball between walls and bricks in integers: every impact is a fraction, and nothing is rounded.

use std::cmp::Ordering;

/// A moment of a step, from 0 to 1, as a fraction with a positive denominator.
#[derive(Clone, Copy, Debug)]
struct Moment(i128, i128);

impl Moment {
    fn of(way: i64, speed: i64) -> Moment {
        let sign = i128::from(speed.signum());
        Moment(sign * i128::from(way), sign * i128::from(speed))
    }

    fn cmp(self, other: Moment) -> Ordering {
        (self.0 * other.1).cmp(&(other.0 * self.1))
    }

    fn is_before(self, other: Moment) -> bool {
        self.cmp(other).is_lt()
    }
}

/// The obstacles of the ball. The ball is a point; obstacles are enlarged by its size instead.
#[derive(Clone, Debug)]
pub struct Billiard {
    pub low: [i64; 2],
    pub high: [i64; 2],
    /// The centres, and the half size of all. If two are hit at once, the first counts.
    pub bricks: Vec<[i64; 2]>,
    pub half: [i64; 2],
    pub at: [i64; 2],
    /// The displacement per step, with its direction.
    pub way: [i64; 2],
}

#[derive(Clone, Copy)]
enum Hit {
    Wall(usize),
    Brick(usize, usize),
}

impl Billiard {
    /// Moves by a whole step, or up to the last brick. Returns the centres of the bricks that were hit, in order; they
    /// are removed. A vertex that is hit exactly counts as a face across y.
    pub fn step(&mut self) -> Vec<[i64; 2]> {
        let (mut from, mut now, mut gone) = (self.at, Moment(0, 1), Vec::new());
        let place = |from: [i64; 2], way: [i64; 2], when: Moment| {
            // The fraction of a tick is dropped only if the last brick ends the step.
            [0, 1].map(|k| from[k] + (i128::from(way[k]) * when.0).div_euclid(when.1) as i64)
        };
        while let Some((when, hit)) = self.next(from, now) {
            now = when;
            let (axis, face) = match hit {
                Hit::Wall(axis) => (axis, if self.way[axis] > 0 { self.high[axis] } else { self.low[axis] }),
                Hit::Brick(index, axis) => {
                    let centre = self.bricks.remove(index);
                    gone.push(centre);
                    (axis, centre[axis] - self.way[axis].signum() * self.half[axis])
                }
            };
            if !gone.is_empty() && self.bricks.is_empty() {
                self.at = place(from, self.way, now);
                return gone;
            }
            // The straight path, reflected at the face.
            from[axis] = 2 * face - from[axis];
            self.way[axis] = -self.way[axis];
        }
        self.at = [0, 1].map(|k| from[k] + self.way[k]);
        gone
    }

    /// Returns the next hit on the straight path, not before `now` and before the end of the step.
    fn next(&self, from: [i64; 2], now: Moment) -> Option<(Moment, Hit)> {
        let mut first = (Moment(1, 1), None);
        for axis in (0..2).filter(|k| self.way[*k] != 0) {
            let face = if self.way[axis] > 0 { self.high[axis] } else { self.low[axis] };
            let when = Moment::of(face - from[axis], self.way[axis]);
            if !when.is_before(now) && when.is_before(first.0) {
                first = (when, Some(Hit::Wall(axis)));
            }
        }
        for (index, centre) in self.bricks.iter().enumerate() {
            if let Some((when, axis)) = self.entry(from, *centre)
                && !when.is_before(now)
                && when.is_before(first.0)
            {
                first = (when, Some(Hit::Brick(index, axis)));
            }
        }
        first.1.map(|hit| (first.0, hit))
    }

    /// Returns when and across which axis the straight path enters a brick.
    fn entry(&self, from: [i64; 2], centre: [i64; 2]) -> Option<(Moment, usize)> {
        let mut enters: Option<(Moment, usize)> = None;
        let mut leaves: Option<Moment> = None;
        // y first: it wins if two faces are hit at once.
        for k in [1, 0] {
            let (low, high) = (centre[k] - self.half[k] - from[k], centre[k] + self.half[k] - from[k]);
            let (near, far) = if self.way[k] > 0 { (low, high) } else { (high, low) };
            if self.way[k] == 0 {
                if low >= 0 || high <= 0 {
                    return None;
                }
                continue;
            }
            let (near, far) = (Moment::of(near, self.way[k]), Moment::of(far, self.way[k]));
            if enters.is_none_or(|(when, _)| when.is_before(near)) {
                enters = Some((near, k));
            }
            if leaves.is_none_or(|when| far.is_before(when)) {
                leaves = Some(far);
            }
        }
        let (enters, leaves) = (enters?, leaves?);
        enters.0.is_before(leaves).then_some(enters)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn empty(at: [i64; 2], way: [i64; 2]) -> Billiard {
        Billiard { low: [3, 5], high: [100, 77], bricks: Vec::new(), half: [6, 4], at, way }
    }

    /// Returns the position of a straight path in a plane tiled with mirrored fields.
    fn folded(along: i64, low: i64, high: i64) -> i64 {
        let length = high - low;
        high - (length - (along - low).rem_euclid(2 * length)).abs()
    }

    #[test]
    fn without_bricks_the_path_unfolds() {
        for way in [[7, 3], [1001, -777], [0, 50], [-123_456, 98_765]] {
            let mut ball = empty([50, 40], way);
            for n in 1..200 {
                assert_eq!(ball.step(), Vec::<[i64; 2]>::new());
                let expected = [0, 1].map(|k| folded([50, 40][k] + n * way[k], ball.low[k], ball.high[k]));
                assert_eq!(ball.at, expected, "{way:?} after {n}");
            }
        }
    }

    #[test]
    fn bricks_are_hit_in_order_and_from_the_right_side() {
        // Two in a row: the nearer one reflects the ball.
        let mut ball = empty([10, 40], [60, 0]);
        ball.bricks = vec![[60, 40], [40, 40]];
        assert_eq!(ball.step(), [[40, 40]]);
        assert_eq!((ball.at, ball.way), ([34 - 36, 40].map(|x: i64| folded(x, 3, 100)), [60, 0]));
        assert_eq!(ball.step(), [[60, 40]]);
        // From below, beyond the edge; and missing it.
        for (x, met) in [(36, 1), (34, 0), (33, 0)] {
            let mut ball = empty([x, 20], [0, 30]);
            ball.bricks = vec![[40, 40], [90, 70]];
            assert_eq!(ball.step().len(), met, "{x}");
        }
        // A vertex, hit exactly: up and down are reversed, left and right are not.
        let mut ball = empty([24, 26], [20, 20]);
        ball.bricks = vec![[40, 46], [90, 70]];
        assert_eq!((ball.step().len(), ball.way), (1, [20, -20]));
    }
}
