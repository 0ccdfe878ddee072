//! The exact engine where every wall has coordinates of its own: what must never happen, and what must not matter.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]

mod images;
mod irregular;
mod noise;

use images::{Image, MIRRORED, TURNED};
use irregular::{Scene, depth, rounding};
use maze_core::Path;
use maze_core::{Ball, BallSpec, Continuous, Engine, Hit, Observer, Plane, Radius, SortedPlanes, Tick};
use nalgebra::Vector2;
use std::sync::Arc;

fn engine(scene: &Scene) -> Continuous {
    let planes = Arc::new(SortedPlanes::new(scene.planes.iter().copied()).unwrap());
    Continuous::new(planes, scene.spec, scene.ball, scene.tick_s).unwrap()
}

/// What the soak looks for at length: 300 scenes of 400 ticks each.
#[test]
fn a_ball_is_never_in_a_wall_and_gains_no_energy() {
    let (mut n_hits, mut n_rests) = (0, 0);
    for seed in 0..300 {
        let Some(scene) = Scene::new(seed) else { continue };
        let (mut engine, radius) = (engine(&scene), scene.spec.radius.units());
        for (n, acceleration) in scene.accelerations(seed).take(400).enumerate() {
            let before = engine.ball();
            let tick = engine.tick(acceleration).unwrap();
            let after = engine.ball();
            let limit = 1.0e-9 * radius + rounding(after.position);
            let depth = depth(&scene.planes, after.position, radius);
            assert!(
                depth <= limit,
                "scene {seed}, tick {n}: {depth} deep, {before:?} -> {after:?}, {tick:?}"
            );
            let acceleration = acceleration * scene.spec.rolling;
            let gain = (after.velocity.norm_squared() - before.velocity.norm_squared()) / 2.0
                - acceleration.dot(&(after.position - before.position));
            let scale =
                before.velocity.norm_squared() + after.velocity.norm_squared() + acceleration.norm() * 20.0;
            assert!(gain <= 1.0e-9 * scale, "scene {seed}, tick {n}: gains {gain}, {before:?} -> {after:?}");
            assert_eq!(tick.corrected_overlap, 0.0, "scene {seed}, tick {n}: {before:?} -> {after:?}");
            assert!(
                tick.dropped_s == 0.0 || 0.99 < scene.spec.restitution,
                "scene {seed}, tick {n}: {tick:?}"
            );
            assert!(
                (after.position - scene.middle).amax() < irregular::HALF,
                "scene {seed}, tick {n}: outside"
            );
            n_hits += tick.n_hits;
            n_rests += tick.n_rests;
        }
    }
    assert!(100_000 < n_hits && 1000 < n_rests, "{n_hits} hits, {n_rests} rests: too few");
}

/// Follows the stretches of a tick and checks that each begins where the one before ended.
struct Stretches {
    at: Vector2<f64>,
    passed_s: f64,
    n_hits: u32,
    largest_gap: f64,
}

impl Stretches {
    fn add(&mut self, [from, to]: [Vector2<f64>; 2], duration_s: f64) {
        self.largest_gap = self.largest_gap.max((from - self.at).amax());
        self.at = to;
        self.passed_s += duration_s;
    }
}

impl Observer for Stretches {
    fn flight(&mut self, path: &Path, duration_s: f64) {
        self.add([path.position, path.at(duration_s)], duration_s);
    }

    fn roll(&mut self, arc: &maze_core::RolledArc, duration_s: f64) {
        self.add([arc.from, arc.to].map(|normal| arc.point + normal * arc.radius), duration_s);
    }

    fn hit(&mut self, hit: &Hit) {
        self.largest_gap = self.largest_gap.max((hit.before.position - self.at).amax());
        self.at = hit.after.position;
        self.n_hits += 1;
    }
}

#[test]
fn an_observer_sees_the_whole_tick_and_changes_nothing() {
    for seed in 5000..5200 {
        let Some(scene) = Scene::new(seed) else { continue };
        let (mut watched, mut alone) = (engine(&scene), engine(&scene));
        for (n, acceleration) in scene.accelerations(seed).take(300).enumerate() {
            let start = watched.ball().position;
            let mut stretches = Stretches { at: start, passed_s: 0.0, n_hits: 0, largest_gap: 0.0 };
            let tick = watched.tick_observed(acceleration, &mut stretches).unwrap();
            let about = format!("scene {seed}, tick {n}: {tick:?}");
            assert_eq!((tick, stretches.n_hits), (alone.tick(acceleration).unwrap(), tick.n_hits), "{about}");
            assert_eq!(watched.state(), alone.state(), "{about}");
            let missing_s = scene.tick_s - tick.dropped_s - stretches.passed_s;
            assert!(missing_s.abs() < 1.0e-12 * scene.tick_s, "{about}: {missing_s} s not shown");
            // A ball is put onto a face that supports it, and onto what it hits, within rounding.
            let rounding = 1.0e-11 * scene.spec.radius.units() + 1.0e-15 * start.amax();
            let last = (watched.ball().position - stretches.at).amax();
            let gap = stretches.largest_gap.max(last);
            assert!(gap <= rounding, "{about}: a gap of {gap}");
        }
    }
}

/// A scene and a factor on top of its image.
struct Scaled {
    image: Image,
    scale: f64,
}

impl Scaled {
    fn of(&self, scene: &Scene) -> Scene {
        let Scene { spec, ball, .. } = *scene;
        Scene {
            planes: scene.planes.iter().map(|plane| (self.image.plane)(*plane)).collect(),
            middle: (self.image.point)(scene.middle),
            spec: BallSpec {
                radius: Radius::new(spec.radius.units() * self.scale).unwrap(),
                resistance: spec.resistance * self.scale,
                ..spec
            },
            ball: self.of_ball(ball),
            ..scene.clone()
        }
    }

    fn of_ball(&self, ball: Ball) -> Ball {
        Ball { position: (self.image.point)(ball.position), velocity: (self.image.point)(ball.velocity) }
    }

    /// Runs scenes and their images side by side: the image of the path is the path of the image, to the bit, and so are rests,
    /// rolls and hits.
    fn holds(&self, seeds: std::ops::Range<u64>) {
        let mut n_rests = 0;
        for seed in seeds {
            let Some(scene) = Scene::new(seed) else { continue };
            let (mut one, mut other) = (engine(&scene), engine(&self.of(&scene)));
            for (n, acceleration) in scene.accelerations(seed).take(300).enumerate() {
                let state = one.state().clone();
                let tick = one.tick(acceleration).unwrap();
                let of_image = other.tick((self.image.point)(acceleration)).unwrap();
                let image = Tick {
                    hardest_hit_speed: tick.hardest_hit_speed * self.scale,
                    deepest_penetration: tick.deepest_penetration * self.scale,
                    ..tick
                };
                assert_eq!(
                    image, of_image,
                    "scene {seed}, tick {n}: {state:?}, acceleration {acceleration:?}"
                );
                assert_eq!(
                    self.of_ball(one.ball()),
                    other.ball(),
                    "scene {seed}, tick {n}: {state:?}, {acceleration:?}"
                );
                n_rests += tick.n_rests;
            }
        }
        assert!(300 < n_rests, "{n_rests} rests: too few");
    }
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_path() {
    Scaled { image: MIRRORED, scale: 1.0 }.holds(1000..1200);
}

#[test]
fn a_scene_turned_by_a_quarter_gives_the_turned_path() {
    Scaled { image: TURNED, scale: 1.0 }.holds(2000..2200);
}

#[test]
fn a_scene_made_smaller_by_a_power_of_two_gives_the_smaller_path() {
    let image = Image {
        point: |v| v / 1024.0,
        plane: |p| Plane { offset: p.offset / 1024.0, start: p.start / 1024.0, end: p.end / 1024.0, ..p },
    };
    Scaled { image, scale: 1.0 / 1024.0 }.holds(3000..3200);
}

#[test]
fn a_scene_made_larger_by_a_power_of_two_gives_the_larger_path() {
    let image = Image {
        point: |v| v * 8.0,
        plane: |p| Plane { offset: p.offset * 8.0, start: p.start * 8.0, end: p.end * 8.0, ..p },
    };
    Scaled { image, scale: 8.0 }.holds(4000..4200);
}
