//! World gravity and the maze's orientation -> the acceleration in the maze plane.
//!
//! The four steps are those of the 2020 student report "Modelling Maze Game Behavior in Physical World".

use nalgebra::{Quaternion, UnitQuaternion, Vector2, Vector3};

/// World gravity (units/s²). One unit is one corridor, and the report takes it as one metre.
pub const WORLD_GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// Step 1: the maze plane's normal in world coordinates, n = R (0, 0, 1).
pub fn plane_normal(world_from_maze: &UnitQuaternion<f64>) -> Vector3<f64> {
    world_from_maze * Vector3::z()
}

/// Step 2: the component of gravity in the plane, P = G - (G . n) n, in world coordinates.
pub fn in_plane(world_gravity: Vector3<f64>, normal: Vector3<f64>) -> Vector3<f64> {
    world_gravity - normal * world_gravity.dot(&normal)
}

/// Step 3: the same vector in maze coordinates, p = R⁻¹ P. Its z is 0 up to rounding.
pub fn to_maze(in_plane: Vector3<f64>, world_from_maze: &UnitQuaternion<f64>) -> Vector3<f64> {
    world_from_maze.inverse() * in_plane
}

/// Steps 1 to 3: the acceleration in the maze plane (units/s²). Step 4, v += p dt, is the engine's.
///
/// A flat maze gives 0, a tilt by θ gives g sin θ downhill, and no orientation gives more than g.
pub fn project(world_gravity: Vector3<f64>, world_from_maze: &UnitQuaternion<f64>) -> Vector2<f64> {
    let normal = plane_normal(world_from_maze);
    to_maze(in_plane(world_gravity, normal), world_from_maze).xy()
}

/// How far the board is tipped, quantised so that live play and a replay see the same bits.
///
/// Held as the rotation's half-angle tangents (Rodrigues parameters) along the two directions in which the board goes
/// down, so that the rotation follows by + - * / sqrt alone, without trigonometry.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tilt {
    /// Steps of [`Tilt::STEP`]; positive: the +x side is down, so the ball runs towards +x.
    pub towards_x: i16,
    /// Steps of [`Tilt::STEP`]; positive: the +y side is down.
    pub towards_y: i16,
}

impl Tilt {
    /// The board lies flat.
    pub const LEVEL: Self = Self { towards_x: 0, towards_y: 0 };

    /// One step of a half-angle tangent: 0.0035 degrees, far finer than the 0.16 degrees of a mouse pixel.
    pub const STEP: f64 = 1.0 / 32_768.0;

    /// The nearest tilt whose half-angle tangents are these; beyond ±1 (90 degrees) and for NaN it saturates or is 0.
    pub fn from_half_tangents(towards_x: f64, towards_y: f64) -> Self {
        // `as` from f64 to i16 is the wanted conversion: it saturates, and takes NaN to 0.
        #[allow(clippy::cast_possible_truncation, reason = "saturates by the language's definition")]
        let steps = |tangent: f64| (tangent / Self::STEP + if tangent < 0.0 { -0.5 } else { 0.5 }) as i16;
        Self { towards_x: steps(towards_x), towards_y: steps(towards_y) }
    }

    /// The nearest tilt that brings the +x side down by one angle (degrees) and the +y side by another: each is the tilt when the
    /// other is 0. Beyond ±90 degrees it saturates, and NaN is 0. The same bits on every platform.
    ///
    /// ```
    /// use maze_core::{Tilt, gravity};
    ///
    /// let acceleration = gravity::project(gravity::WORLD_GRAVITY, &Tilt::degrees(30.0, 0.0).world_from_maze());
    /// assert!((acceleration.x - 9.81 / 2.0).abs() < 1.0e-3);
    /// ```
    pub fn degrees(towards_x: f64, towards_y: f64) -> Self {
        Self::from_half_tangents(half_tangent(towards_x), half_tangent(towards_y))
    }

    /// The half-angle tangents (towards +x, towards +y).
    pub fn half_tangents(self) -> [f64; 2] {
        [f64::from(self.towards_x) * Self::STEP, f64::from(self.towards_y) * Self::STEP]
    }

    /// The rotation from maze to world coordinates; it has no turn about the board's normal.
    pub fn world_from_maze(self) -> UnitQuaternion<f64> {
        let [x, y] = self.half_tangents();
        // Down towards +x is a turn about +y; down towards +y is a turn about -x.
        // 0 - y and not -y: a level board has no negative zero.
        UnitQuaternion::new_normalize(Quaternion::new(1.0, 0.0 - y, x, 0.0))
    }
}

/// The tangent of half an angle (degrees) of at most 90 degrees, by Lambert's continued fraction x / (1 - x² / (3 - x² / (5 - ..))):
/// the standard library's differs between platforms.
fn half_tangent(degrees: f64) -> f64 {
    if 90.0 <= degrees.abs() {
        return if degrees < 0.0 { -1.0 } else { 1.0 };
    }
    let half = degrees * (std::f64::consts::PI / 360.0);
    let mut denominator = 19.0;
    for odd in [17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0] {
        denominator = odd - half * half / denominator;
    }
    half / denominator
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use trigonometry")]
mod tests {
    use super::*;

    /// Rounding of a few products of numbers up to g.
    const ROUNDING: f64 = 1.0e-14;

    fn about(axis: Vector3<f64>, degrees: f64) -> UnitQuaternion<f64> {
        UnitQuaternion::from_scaled_axis(axis * degrees.to_radians())
    }

    #[test]
    fn step_1_normal_is_the_turned_z_axis() {
        let n = plane_normal(&about(Vector3::y(), 90.0));
        assert!((n - Vector3::x()).norm() < ROUNDING, "{n}");
    }

    #[test]
    fn step_2_projection_is_perpendicular_to_the_normal() {
        let n = plane_normal(&about(Vector3::new(0.6, 0.8, 0.0), 33.0));
        let p = in_plane(WORLD_GRAVITY, n);
        assert!(p.dot(&n).abs() < ROUNDING);
        assert!((p.norm() - 9.81 * 33.0_f64.to_radians().sin()).abs() < ROUNDING);
    }

    #[test]
    fn step_3_maze_coordinates_have_no_z() {
        for degrees in [0.0, 1.0, 20.0, 90.0, 135.0, 180.0] {
            let orientation = about(Vector3::new(0.6, 0.8, 0.0), degrees);
            let p = to_maze(in_plane(WORLD_GRAVITY, plane_normal(&orientation)), &orientation);
            assert!(p.z.abs() < ROUNDING, "{degrees} degrees: {p}");
        }
    }

    #[test]
    fn flat_maze_gives_zero() {
        assert_eq!(project(WORLD_GRAVITY, &Tilt::LEVEL.world_from_maze()), Vector2::zeros());
    }

    #[test]
    fn tilt_by_theta_gives_g_sin_theta_downhill() {
        for degrees in [0.5, 5.0, 20.0, 60.0] {
            let expected = 9.81 * f64::to_radians(degrees).sin();
            let x = project(WORLD_GRAVITY, &about(Vector3::y(), degrees));
            assert!((x - Vector2::new(expected, 0.0)).norm() < ROUNDING, "{x}");
            let y = project(WORLD_GRAVITY, &about(-Vector3::x(), degrees));
            assert!((y - Vector2::new(0.0, expected)).norm() < ROUNDING, "{y}");
        }
    }

    #[test]
    fn no_orientation_gives_more_than_g_and_upside_down_is_finite() {
        for i in 0..1000 {
            let t = f64::from(i);
            let axis = Vector3::new((t * 0.7).sin(), (t * 1.3).cos(), (t * 0.37).sin());
            let p = project(WORLD_GRAVITY, &UnitQuaternion::from_scaled_axis(axis * 4.0));
            assert!(p.norm() <= 9.81 + ROUNDING);
        }
        assert!(project(WORLD_GRAVITY, &about(Vector3::x(), 180.0)).norm() < ROUNDING);
    }

    #[test]
    fn tilt_runs_the_ball_towards_the_side_that_is_down() {
        let p = project(WORLD_GRAVITY, &Tilt::from_half_tangents(0.1, -0.05).world_from_maze());
        assert!(0.0 < p.x && p.y < 0.0, "{p}");
    }

    #[test]
    fn tilt_saturates_and_takes_nan_to_level() {
        assert_eq!(
            Tilt::from_half_tangents(f64::INFINITY, -7.0),
            Tilt { towards_x: i16::MAX, towards_y: i16::MIN }
        );
        assert_eq!(Tilt::from_half_tangents(f64::NAN, 0.0), Tilt::LEVEL);
    }

    #[test]
    fn an_angle_in_degrees_is_the_nearest_step() {
        for n in -9000..=9000 {
            let degrees = f64::from(n) / 100.0;
            let truth = (degrees.to_radians() / 2.0).tan();
            assert!((half_tangent(degrees) - truth).abs() < 1.0e-15, "{degrees}");
        }
        assert_eq!(Tilt::degrees(400.0, -90.0), Tilt { towards_x: i16::MAX, towards_y: i16::MIN });
        assert_eq!(Tilt::degrees(f64::NAN, 0.0), Tilt::LEVEL);
    }

    #[test]
    fn tilt_round_trips_through_its_tangents() {
        for steps in [-32_000, -1, 0, 1, 5_000, 32_767] {
            let tilt = Tilt { towards_x: steps, towards_y: 0 };
            let [x, y] = tilt.half_tangents();
            assert_eq!(Tilt::from_half_tangents(x, y), tilt);
        }
    }
}
