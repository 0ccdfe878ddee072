//! Times of impact: the guided search against the scan, and corner touches against the path itself.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts and cells, small and not negative"
)]
#![allow(
    clippy::disallowed_methods,
    reason = "the truth that a test compares with may be computed in any way"
)]

use maze_core::time_of_impact;
use maze_core::{Facing, Feature, Path, Plane, SortedPlanes, Sweep, SweepQuery, contact, sweep};
use nalgebra::Vector2;
use proptest::prelude::*;

fn plane(facing: Facing, offset: f64, start: f64, end: f64) -> Plane {
    Plane { facing, offset, start, end }
}

/// A block from the origin to (1, 1).
fn unit_block() -> [Plane; 4] {
    [
        plane(Facing::MinusX, 0.0, 0.0, 1.0),
        plane(Facing::PlusX, 1.0, 0.0, 1.0),
        plane(Facing::MinusY, 0.0, 0.0, 1.0),
        plane(Facing::PlusY, 1.0, 0.0, 1.0),
    ]
}

fn query(path: &Path, radius: f64, until_s: f64) -> SweepQuery {
    SweepQuery::new(*path, radius, until_s).unwrap()
}

#[test]
fn of_two_touches_at_the_very_start_the_one_that_is_approached_faster_is_found() {
    // In a corner, moving onto one face and pulled onto the other.
    let planes = [plane(Facing::PlusX, 0.0, 0.0, 5.0), plane(Facing::PlusY, 0.0, 0.0, 5.0)];
    let planes = SortedPlanes::new(planes).unwrap();
    for (velocity, acceleration, facing) in [
        ([0.0, -1.0], [-1.0, 0.0], Facing::PlusY),
        ([-1.0, 0.0], [0.0, -1.0], Facing::PlusX),
        // And of two that are approached alike the first in the order of facings.
        ([-1.0, -1.0], [0.0, 0.0], Facing::PlusX),
    ] {
        let [velocity, acceleration] = [velocity, acceleration].map(|[x, y]| Vector2::new(x, y));
        let path = Path { position: Vector2::new(0.35, 0.35), velocity, acceleration };
        let first = sweep::first_impact(&planes, &query(&path, 0.35, 0.03));
        assert_eq!(first, sweep::first_impact_scan(&planes, &query(&path, 0.35, 0.03)));
        assert!(matches!(first.unwrap().feature, Feature::Face(face) if face.facing == facing));
    }
}

#[test]
fn a_corner_is_met_by_a_ball_that_starts_too_slowly_for_squares() {
    let planes = SortedPlanes::new([plane(Facing::MinusX, 3.0, -0.1, 5.0)]).unwrap();
    let path = Path {
        position: Vector2::new(0.0, -0.2),
        velocity: Vector2::repeat(1.5e-162),
        acceleration: Vector2::new(10.0, 0.0),
    };
    let truth = time_of_impact::corner(&path, 0.35, Vector2::new(3.0, -0.1), 1.0);
    assert_eq!(sweep::first_impact(&planes, &query(&path, 0.35, 1.0)).map(|impact| impact.time_s), truth);
    assert!(truth.is_some());
}

/// Cells along a side of a random ground plan.
const N: usize = 8;

/// A random ground plan: which cells are solid, and how wide they are.
#[derive(Clone, Debug)]
struct Plan {
    solid: Vec<bool>,
    pitch: f64,
}

impl Plan {
    /// Cells count from 1; what lies around is free.
    fn is_solid(&self, i: usize, j: usize) -> bool {
        (1..=N).contains(&i) && (1..=N).contains(&j) && self.solid[(j - 1) * N + i - 1]
    }

    fn at(&self, k: usize) -> f64 {
        (k as f64 - N as f64 / 2.0 - 1.0) * self.pitch
    }

    fn is_inside(&self, position: Vector2<f64>) -> bool {
        let cell = |value: f64| (value / self.pitch + N as f64 / 2.0 + 1.0).floor().max(0.0) as usize;
        self.is_solid(cell(position.x), cell(position.y))
    }

    /// As an importer makes them.
    fn faces(&self) -> Vec<Plane> {
        let mut faces = Vec::new();
        for across in 1..=N {
            for step in 0..=N {
                let [offset, start, end] = [step + 1, across, across + 1].map(|k| self.at(k));
                match (self.is_solid(step, across), self.is_solid(step + 1, across)) {
                    (true, false) => faces.push(plane(Facing::PlusX, offset, start, end)),
                    (false, true) => faces.push(plane(Facing::MinusX, offset, start, end)),
                    _ => {}
                }
                match (self.is_solid(across, step), self.is_solid(across, step + 1)) {
                    (true, false) => faces.push(plane(Facing::PlusY, offset, start, end)),
                    (false, true) => faces.push(plane(Facing::MinusY, offset, start, end)),
                    _ => {}
                }
            }
        }
        faces
    }
}

fn any_plan() -> impl Strategy<Value = Plan> {
    (prop::collection::vec(prop::bool::weighted(0.3), N * N), 0.3..2.0_f64)
        .prop_map(|(solid, pitch)| Plan { solid, pitch })
}

fn any_path() -> impl Strategy<Value = Path> {
    let vector = |most: f64| (-most..most, -most..most).prop_map(|(x, y)| Vector2::new(x, y));
    let still = prop_oneof![Just(Vector2::zeros()), vector(10.0)];
    let along_an_axis = (0..2_usize, -9.0..9.0_f64).prop_map(|(axis, speed)| {
        let mut velocity = Vector2::zeros();
        velocity[axis] = speed;
        velocity
    });
    (vector(5.0), prop_oneof![vector(2.0), vector(300.0), still.clone(), along_an_axis], still)
        .prop_map(|(position, velocity, acceleration)| Path { position, velocity, acceleration })
}

/// The earliest of all touches of all faces and all their ends, with nothing passed over: not even corners where faces meet
/// inward, which the search and its scan both leave out because nothing is touched there first.
fn earliest(planes: &SortedPlanes, path: &Path, radius: f64, until_s: f64) -> Option<f64> {
    let times = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).flat_map(|face| {
        let ends = [face.start, face.end].map(|along| face.facing.point(face.offset, along));
        let corners = ends.map(|point| time_of_impact::corner(path, radius, point, until_s));
        corners.into_iter().chain([time_of_impact::face(path, radius, &face)]).flatten().collect::<Vec<_>>()
    });
    times.filter(|time_s| *time_s <= until_s).min_by(f64::total_cmp)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 20_000, max_global_rejects: 1_000_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// The guided search finds what the scan of every plane finds, to the bit.
    #[test]
    fn guided_search_agrees_with_scan(
        plan in any_plan(),
        path in any_path(),
        radius in 0.05..1.0_f64,
        until_s in prop_oneof![Just(0.03), 0.001..1.0_f64],
    ) {
        let sorted = SortedPlanes::new(plan.faces()).unwrap();
        // A path that starts inside a wall has no first touch from outside.
        let overlaps = |plane: &Plane| contact::find(path.position, radius, plane).is_some();
        prop_assume!(!plan.is_inside(path.position) && !plan.faces().iter().any(overlaps));
        let truth = sweep::first_impact_scan(&sorted, &query(&path, radius, until_s));
        prop_assert_eq!(sweep::first_impact(&sorted, &query(&path, radius, until_s)), truth);
        prop_assert!(truth.is_none_or(|impact| (0.0..=until_s).contains(&impact.time_s)), "{:?}", truth);
        prop_assert_eq!(sweep::first_impact(&sorted.clone().without_bucket_index(), &query(&path, radius, until_s)), truth);
        prop_assert_eq!(truth.map(|impact| impact.time_s), earliest(&sorted, &path, radius, until_s));
    }

    /// Walls without thickness too, whose ends no other face covers.
    #[test]
    fn guided_search_agrees_with_scan_on_walls_without_thickness(
        walls in prop::collection::vec((prop::bool::ANY, -5..5_i32, -5..5_i32, 1..4_i32), 1..20),
        path in any_path(),
        radius in 0.05..0.45_f64,
    ) {
        let sides = walls.iter().flat_map(|&(is_across_x, offset, start, extent)| {
            let [offset, start, end] = [offset, start, start + extent].map(f64::from);
            let facings =
                if is_across_x { [Facing::PlusX, Facing::MinusX] } else { [Facing::PlusY, Facing::MinusY] };
            facings.map(|facing| plane(facing, offset, start, end))
        });
        let sorted = SortedPlanes::new(sides).unwrap();
        prop_assume!(sorted.planes_within(path.position, radius).next().is_none());
        let truth = sweep::first_impact_scan(&sorted, &query(&path, radius, 0.5));
        prop_assert_eq!(sweep::first_impact(&sorted, &query(&path, radius, 0.5)), truth);
        prop_assert_eq!(truth.map(|impact| impact.time_s), earliest(&sorted, &path, radius, 0.5));
    }

    /// At the time of a corner's touch the distance is the radius, and before it was more.
    #[test]
    fn corner_touch_is_at_the_radius_and_the_first(path in any_path(), radius in 0.05..1.0_f64) {
        let start = path.position.norm();
        prop_assume!(radius + 1.0e-6 < start);
        if let Some(time_s) = time_of_impact::corner(&path, radius, Vector2::zeros(), 1.0) {
            let scale = 1.0 + path.velocity.norm() + path.acceleration.norm();
            prop_assert!((path.at(time_s).norm() - radius).abs() < 1.0e-13 * scale * scale, "{}", path.at(time_s).norm() - radius);
            for part in 1..200_u32 {
                let earlier = path.at(time_s * f64::from(part) / 200.0).norm();
                prop_assert!(radius - 1.0e-9 < earlier);
            }
        } else {
            for part in 0..=2000_u32 {
                let distance = path.at(f64::from(part) / 2000.0).norm();
                prop_assert!(radius - 1.0e-7 < distance, "{} at {}", distance, part);
            }
        }
    }
}

#[test]
fn faces_and_corners_of_a_scene_are_told_apart() {
    let unit_block = unit_block();
    let planes = SortedPlanes::new(unit_block).unwrap();
    let towards = |y: f64| Path {
        position: Vector2::new(-2.0, y),
        velocity: Vector2::new(1.0, 0.0),
        acceleration: Vector2::zeros(),
    };
    let hit = |y| sweep::first_impact(&planes, &query(&towards(y), 0.25, 9.0)).map(|impact| impact.feature);
    assert!(matches!(hit(0.5), Some(Feature::Face(face)) if face.facing == Facing::MinusX));
    assert_eq!(hit(1.1), Some(Feature::Point(Vector2::new(0.0, 1.0))));
    assert_eq!(hit(1.3), None);
}

#[test]
fn a_wall_without_thickness_is_hit_on_its_end() {
    let wall = [Facing::PlusX, Facing::MinusX].map(|facing| plane(facing, 0.0, 0.0, 1.0));
    let planes = SortedPlanes::new(wall).unwrap();
    let down = Path {
        position: Vector2::new(0.0, 3.0),
        velocity: Vector2::new(0.0, -1.0),
        acceleration: Vector2::zeros(),
    };
    let impact = sweep::first_impact(&planes, &query(&down, 0.25, 9.0)).unwrap();
    assert_eq!((impact.time_s, impact.feature), (1.75, Feature::Point(Vector2::new(0.0, 1.0))));
}

#[test]
fn a_ball_that_stands_on_a_corner_and_is_pressed_onto_it_does_not_sink_in() {
    // Found by the soak after 10^8 ticks: the distance at the start is the radius plus half a rounding, its slope nothing, and
    // its farthest point, a rounding later, is the radius less half of one.
    let path = Path {
        position: Vector2::new(3.903_872_500_213_596, 2.938_359_983_125_049),
        velocity: Vector2::new(16.559_809_472_969_576, -7.701_637_672_871_311),
        acceleration: Vector2::new(-706.269_780_920_510_7, -451.637_454_820_102_96),
    };
    let point = Vector2::new(3.699_999_999_999_999_3, 2.5);
    let time_s = time_of_impact::corner(&path, 0.483_449_553_882_032_6, point, 0.03).unwrap();
    assert!(time_s < 1.0e-7, "{time_s}");
}

#[test]
fn a_sweep_tells_a_hit_an_overlap_and_a_free_path() {
    let unit_block = unit_block();
    let planes = SortedPlanes::new(unit_block).unwrap();
    let sweep = |from: [f64; 2], velocity: [f64; 2]| {
        let path = Path { position: from.into(), velocity: velocity.into(), acceleration: Vector2::zeros() };
        planes.sweep(&query(&path, 0.25, 9.0))
    };
    assert_eq!(sweep([-2.0, 1.3], [1.0, 0.0]), Sweep::Free);
    let Sweep::Hit { time_s, point, normal, wall, .. } = sweep([-2.0, 0.5], [1.0, 0.0]) else {
        panic!("a wall is in the way");
    };
    assert_eq!((time_s, point, normal), (1.75, Vector2::new(0.0, 0.5), -Vector2::x()));
    assert_eq!(wall, unit_block[0]);
    // The upper left corner: of the two faces that end there, the first in the order of facings is named.
    let Sweep::Hit { point, wall, feature, .. } = sweep([-0.1, 3.0], [0.0, -1.0]) else {
        panic!("a corner is in the way");
    };
    assert_eq!((point, feature), (Vector2::new(0.0, 1.0), Feature::Point(Vector2::new(0.0, 1.0))));
    assert_eq!(wall, unit_block[0]);
    let Sweep::Overlaps { wall, depth, .. } = sweep([-0.2, 0.5], [1.0, 0.0]) else {
        panic!("it starts in the wall");
    };
    assert!(wall == unit_block[0] && (depth - 0.05).abs() < 1.0e-15);
    // At the radius it touches, and does not overlap.
    assert!(matches!(sweep([-0.25, 0.5], [1.0, 0.0]), Sweep::Hit { time_s: 0.0, .. }));
    assert_eq!(sweep([-0.25, 0.5], [-1.0, 0.0]), Sweep::Free);
}

#[test]
fn a_query_refuses_what_is_no_circle_on_a_path() {
    let still =
        Path { position: Vector2::zeros(), velocity: Vector2::zeros(), acceleration: Vector2::zeros() };
    let bad = [f64::NAN, f64::INFINITY, -1.0];
    for radius in bad.into_iter().chain([0.0, 1.0e200]) {
        assert!(SweepQuery::new(still, radius, 1.0).is_err(), "radius {radius}");
    }
    for until_s in bad {
        assert!(SweepQuery::new(still, 1.0, until_s).is_err(), "until {until_s}");
    }
    for value in [f64::NAN, f64::INFINITY, 1.0e200] {
        for which in 0..6 {
            let mut path = still;
            [&mut path.position, &mut path.velocity, &mut path.acceleration][which / 2][which % 2] = value;
            let error = SweepQuery::new(path, 1.0, 1.0).unwrap_err();
            assert_eq!(error.to_string(), "the path of the circle: expected a finite number");
        }
    }
    assert!(SweepQuery::new(still, 1.0, 0.0).is_ok());
}
