//! How the board is tilted over time.

use maze_core::gravity::{WORLD_GRAVITY, project};
use nalgebra::{UnitQuaternion, Vector2, Vector3};

/// A schedule of tilts. Angles in degrees, as the angle by which the board's +x (+y) side goes down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gravity {
    /// Level.
    Flat,
    /// Held still.
    Constant {
        /// Towards +x and +y.
        tilt_deg: [f64; 2],
    },
    /// To and fro, from its largest tilt on: the board begins at rest.
    Sinusoidal {
        /// Largest tilt towards +x and +y.
        amplitude_deg: [f64; 2],
        /// Hz.
        frequency_hz: f64,
    },
    /// A new random tilt every so often, reached without a jerk: a hand that hunts for a way.
    Random {
        /// The same seed gives the same tilts.
        seed: u64,
        /// From one tilt to the next (s).
        hold_s: f64,
        /// Largest tilt along each of x and y.
        max_deg: f64,
    },
}

/// Numbers that look random and are the same everywhere, -1 to 1 (splitmix64).
fn noise(seed: u64, index: u64) -> f64 {
    let mut z = seed.wrapping_add(index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    #[allow(clippy::cast_precision_loss, reason = "53 bits are kept on purpose")]
    let fraction = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64;
    fraction - 1.0
}

impl Gravity {
    /// Tilt towards +x and +y at a time (degrees).
    pub fn tilt_deg(&self, time_s: f64) -> [f64; 2] {
        match *self {
            Self::Flat => [0.0; 2],
            Self::Constant { tilt_deg } => tilt_deg,
            Self::Sinusoidal { amplitude_deg: [x, y], frequency_hz } => {
                let cos = (std::f64::consts::TAU * frequency_hz * time_s).cos();
                [x * cos, y * cos]
            }
            Self::Random { seed, hold_s, max_deg } => {
                let knots = time_s / hold_s;
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count from 0")]
                let index = knots.floor() as u64;
                let fraction = knots - knots.floor();
                let fraction = fraction * fraction * (3.0 - 2.0 * fraction);
                [0, 1].map(|axis| {
                    // The board begins level.
                    let knot = |k: u64| if k == 0 { 0.0 } else { max_deg * noise(seed, 2 * k + axis) };
                    knot(index) * (1.0 - fraction) + knot(index + 1) * fraction
                })
            }
        }
    }

    /// How the board lies: turned about one axis in its plane, so that it goes down along the tilt by the tilt's length.
    pub fn world_from_maze(&self, time_s: f64) -> UnitQuaternion<f64> {
        let [x, y] = self.tilt_deg(time_s).map(f64::to_radians);
        UnitQuaternion::from_scaled_axis(Vector3::new(-y, x, 0.0))
    }

    /// Projected gravity (units/s²), before the ball's rolling factor.
    pub fn acceleration(&self, time_s: f64) -> Vector2<f64> {
        project(WORLD_GRAVITY, &self.world_from_maze(time_s))
    }

    /// Acceleration of tick `index`: that of its middle. Constant tilts give the same bits for every tick.
    pub fn of_tick(&self, index: u32, tick_s: f64) -> Vector2<f64> {
        self.acceleration((f64::from(index) + 0.5) * tick_s)
    }

    /// Whether it is the same at all times.
    pub fn is_constant(&self) -> bool {
        matches!(self, Self::Flat | Self::Constant { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tilt_pulls_by_g_times_its_sine_towards_the_side_that_is_down() {
        let down_y = Gravity::Constant { tilt_deg: [0.0, -30.0] }.acceleration(1.0);
        assert!((down_y - Vector2::new(0.0, -4.905)).norm() < 1.0e-14, "{down_y}");
        assert_eq!(Gravity::Flat.acceleration(3.0), Vector2::zeros());
    }

    #[test]
    fn random_tilts_are_steady_bounded_and_begin_level() {
        let random = Gravity::Random { seed: 5, hold_s: 0.5, max_deg: 8.0 };
        assert_eq!(random.tilt_deg(0.0), [0.0; 2]);
        let mut largest = 0.0_f64;
        for step in 0..10_000_u32 {
            let [now, next] = [0.0, 0.001].map(|ahead| random.tilt_deg(f64::from(step) * 0.001 + ahead));
            for axis in [0, 1] {
                assert!((next[axis] - now[axis]).abs() <= 1.5 * 16.0 / 0.5 * 0.001 + 1.0e-9);
                largest = largest.max(now[axis].abs());
            }
        }
        assert!((4.0..=8.0).contains(&largest));
    }
}
