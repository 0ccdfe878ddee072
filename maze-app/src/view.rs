//! The camera: the whole maze at first, nearer with the ball in the middle when zoomed in.

use crate::numbers::to_f32;
use maze_render::{Camera, FIELD_OF_VIEW_RAD, PITCH_RAD};
use nalgebra::Vector3;
use std::time::Duration;

/// How far the player may go: 1 shows the whole maze.
pub(crate) const ZOOM_RANGE: [f64; 2] = [0.5, 6.0];

/// What one key press or notch of the wheel multiplies the zoom by.
const ZOOM_PER_NOTCH: f64 = 1.15;

/// From this zoom on the ball is kept in the middle; in between the view slides over to it.
const FOLLOW_ZOOM: f64 = 2.0;

/// Time in which the view covers all but a third of its way (s): quick, and without a jerk.
const SETTLE_S: f64 = 0.09;

/// Room beside a covered part, as a fraction of it: a board off the middle of the view reaches farther out.
const ROOM_BESIDE: f32 = 0.1;

/// A view of the whole board that [`beside`] a covered part of the width still holds all of it.
pub(crate) fn fitted(
    pitch_rad: f32,
    half_size: [f32; 3],
    aspect: f32,
    max_tilt_rad: f32,
    covered: f32,
) -> Camera {
    Camera::fitted_at(pitch_rad, half_size, aspect * (1.0 - (1.0 + ROOM_BESIDE) * covered), max_tilt_rad)
}

/// The same view with its middle in what is left of the width when a part of it, on the left, is covered.
pub(crate) fn beside(camera: Camera, aspect: f32, covered: f32) -> Camera {
    let shift = covered * aspect * (FIELD_OF_VIEW_RAD / 2.0).tan() * camera.distance;
    let target = Vector3::from(camera.target) - Vector3::new(shift, 0.0, 0.0);
    Camera { target: target.into(), ..camera }
}

/// A view that leaves parts of the height free at the lower and at the upper edge: farther away, and its middle in what is left.
pub(crate) fn with_room(camera: Camera, below: f32, above: f32) -> Camera {
    let distance = camera.distance / (1.0 - below - above);
    let down = (below - above) * (FIELD_OF_VIEW_RAD / 2.0).tan() * distance;
    let target = Vector3::from(camera.target) - camera.world_from_view() * Vector3::new(0.0, down, 0.0);
    Camera { target: target.into(), distance, ..camera }
}

/// A view that many times nearer than `whole`, the ball in its middle from [`FOLLOW_ZOOM`] on; `ball` is in the world.
pub(crate) fn zoomed(whole: Camera, zoom: f64, ball: Vector3<f32>) -> Camera {
    let follow = ((zoom - 1.0) / (FOLLOW_ZOOM - 1.0)).clamp(0.0, 1.0);
    let middle = Vector3::from(whole.target);
    let target = middle + (ball - middle) * to_f32(follow);
    Camera { target: target.into(), distance: whole.distance / to_f32(zoom), ..whole }
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    wanted_zoom: f64,
    zoom: f64,
    camera: Camera,
}

impl Default for View {
    fn default() -> Self {
        Self {
            wanted_zoom: 1.0,
            zoom: 1.0,
            camera: Camera { target: [0.0; 3], distance: 1.0, pitch_rad: PITCH_RAD },
        }
    }
}

impl View {
    pub(crate) fn zoom_by_notches(&mut self, notches: f64) {
        let zoom = self.wanted_zoom * ZOOM_PER_NOTCH.powf(notches);
        self.wanted_zoom = zoom.clamp(ZOOM_RANGE[0], ZOOM_RANGE[1]);
    }

    /// Back to the whole maze.
    pub(crate) fn show_all(&mut self) {
        self.wanted_zoom = 1.0;
        self.zoom = 1.0;
    }

    pub(crate) fn camera(&self) -> Camera {
        self.camera
    }

    /// At this zoom: `whole` shows the whole maze.
    pub(crate) fn look(&self, whole: Camera, ball: Vector3<f32>) -> Camera {
        zoomed(whole, self.zoom, ball)
    }

    /// Moves towards what is wanted: `whole` shows the whole maze, `ball` is where the ball is in the world. `nearest` is the
    /// least zoom: 1, or more where the view follows the ball. Without `slides` it is there at once.
    pub(crate) fn update(
        &mut self,
        elapsed: Duration,
        whole: Camera,
        ball: Vector3<f32>,
        nearest: f64,
        slides: bool,
    ) {
        let wanted = (self.wanted_zoom * nearest).clamp(ZOOM_RANGE[0], ZOOM_RANGE[1]);
        let left = if slides { (-elapsed.as_secs_f64() / SETTLE_S).exp() } else { 0.0 };
        self.zoom = wanted + (self.zoom - wanted) * left;
        self.camera = self.look(whole, ball);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WHOLE: Camera = Camera { target: [0.0, 1.0, 0.0], distance: 20.0, pitch_rad: PITCH_RAD };

    fn settled(notches: f64) -> Camera {
        let mut view = View::default();
        view.zoom_by_notches(notches);
        view.update(Duration::from_secs(10), WHOLE, Vector3::new(3.0, 4.0, 0.0), 1.0, true);
        view.camera()
    }

    #[test]
    fn zoom_stays_within_its_limits() {
        assert_eq!(settled(0.0), WHOLE);
        let [farthest, nearest] = ZOOM_RANGE.map(|zoom| 20.0 / to_f32(zoom));
        assert!((settled(100.0).distance - nearest).abs() < 1.0e-4);
        assert!((settled(-100.0).distance - farthest).abs() < 1.0e-4);
    }

    #[test]
    fn room_below_moves_the_picture_up_and_makes_it_smaller() {
        let size = [1000, 1000];
        let middle = |camera: Camera| camera.project(size, WHOLE.target).unwrap();
        assert_eq!(middle(with_room(WHOLE, 0.0, 0.0)), middle(WHOLE));
        let [x, y] = middle(with_room(WHOLE, 0.2, 0.0));
        // Above a free fifth the middle lies at 40 % of the height.
        assert!((x - 500.0).abs() < 0.1 && (y - 400.0).abs() < 0.1, "{x}, {y}");
    }

    #[test]
    fn beside_a_covered_part_the_middle_is_that_of_the_rest() {
        let [x, y] = beside(WHOLE, 2.0, 0.25).project([1000, 500], WHOLE.target).unwrap();
        // A quarter is covered: the rest goes from 250 to 1000.
        assert!((x - 625.0).abs() < 0.1 && (y - 250.0).abs() < 0.1, "{x}, {y}");
    }

    #[test]
    fn the_ball_is_in_the_middle_when_zoomed_in() {
        assert_eq!(settled(20.0).target, [3.0, 4.0, 0.0]);
        assert_eq!(settled(-3.0).target, WHOLE.target);
    }
}
