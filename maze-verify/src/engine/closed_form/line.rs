//! A ball on a line between two walls.

/// Bounces that rise less than this (units) are rest: far below every tolerance.
const REST_APEX: f64 = 1.0e-15;

/// Most bounces along one axis: with a restitution of 0.99 a fall from 1 unit ends after 1700.
const MAX_BOUNCES: u32 = 1_000_000;

/// One axis of a room, for the centre of the ball.
pub(super) struct Line {
    pub(super) low: Option<f64>,
    pub(super) high: Option<f64>,
    pub(super) acceleration: f64,
    pub(super) restitution: f64,
}

impl Line {
    /// Position and velocity after a time; `None` after too many bounces.
    pub(super) fn at(&self, mut position: f64, mut velocity: f64, time_s: f64) -> Option<(f64, f64)> {
        let mut left_s = time_s;
        for _ in 0..MAX_BOUNCES {
            let high =
                self.high.and_then(|wall| arrival(wall - position, velocity, self.acceleration, wall, -1.0));
            let low =
                self.low.and_then(|wall| arrival(position - wall, -velocity, -self.acceleration, wall, 1.0));
            let next = [high, low].into_iter().flatten().min_by(|a, b| a.time_s.total_cmp(&b.time_s));
            let Some(hit) = next.filter(|hit| hit.time_s <= left_s) else {
                let half = self.acceleration * left_s / 2.0;
                return Some((position + (velocity + half) * left_s, velocity + self.acceleration * left_s));
            };
            left_s -= hit.time_s;
            position = hit.wall;
            let rebound = self.restitution * hit.speed;
            let pressing = -hit.away * self.acceleration;
            if 0.0 < pressing && rebound * rebound < 2.0 * pressing * REST_APEX {
                return Some((position, 0.0));
            }
            velocity = hit.away * rebound;
        }
        None
    }
}

pub(super) struct Arrival {
    pub(super) time_s: f64,
    pub(super) speed: f64,
    wall: f64,
    away: f64,
}

/// When a gap closes at a speed that grows by `acceleration`, and how fast then: gap = v t + a t² / 2.
pub(super) fn arrival(gap: f64, speed: f64, acceleration: f64, wall: f64, away: f64) -> Option<Arrival> {
    let squared = speed * speed + 2.0 * acceleration * gap;
    if squared < 0.0 {
        return None;
    }
    let at_wall = squared.sqrt();
    let time_s = if 0.0 < speed {
        2.0 * gap / (speed + at_wall)
    } else if 0.0 < acceleration {
        (at_wall - speed) / acceleration
    } else {
        return None;
    };
    Some(Arrival { time_s, speed: at_wall, wall, away })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(low: Option<f64>, high: Option<f64>, acceleration: f64) -> Line {
        Line { low, high, acceleration, restitution: 0.8 }
    }

    #[test]
    fn the_fall_that_schoolbooks_tell() {
        let fall = line(Some(0.0), None, -2.0);
        // From 1 unit: down after 1 s at 2 units/s, up to 0.64 after another 0.8 s.
        assert!((fall.at(1.0, 0.0, 0.5).unwrap().0 - 0.75).abs() < 1.0e-15);
        let (height, speed) = fall.at(1.0, 0.0, 1.8).unwrap();
        assert!((height - 0.64).abs() < 1.0e-15 && speed.abs() < 1.0e-15);
        // All bounces take 1 + 2 (0.8 + 0.64 + ...) = 9 s; then it lies.
        assert!(0.0 < fall.at(1.0, 0.0, 8.9).unwrap().0);
        assert_eq!(fall.at(1.0, 0.0, 9.0 + 1.0e-6).unwrap(), (0.0, 0.0));
    }

    #[test]
    fn to_and_fro_without_pull() {
        let corridor = line(Some(0.0), Some(1.0), 0.0);
        assert!((corridor.at(0.0, 1.0, 2.5).unwrap().1 - 0.64).abs() < 1.0e-15);
        assert!((corridor.at(0.0, 1.0, 1.5).unwrap().0 - 0.6).abs() < 1.0e-15);
    }
}
