//! The cross-check finds nothing wrong with the engines, and finds every fault that is planted.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use maze_core::{
    Ball, BallSpec, Bounds, Continuous, Engine, Facing, Observer, OutOfRange, Plane, Tick, time_of_impact,
};
use maze_verify::results::{Partition, Results};
use maze_verify::scene::{Scene, Stage, catalogue};
use maze_verify::{Board, Build, Contender, RapierEngine, Walls, build, report, run};
use nalgebra::Vector2;

fn scenes(names: &[&str]) -> Vec<(usize, Scene)> {
    let chosen: Vec<_> =
        catalogue().unwrap().into_iter().filter(|scene| names.contains(&scene.name.as_str())).collect();
    assert_eq!(chosen.len(), names.len());
    chosen.into_iter().enumerate().collect()
}

fn results(names: &[&str], engines: &[Contender], build: &Build) -> Results {
    let scenes = scenes(names);
    let done = run(&scenes, engines, build, &|_| {}).unwrap();
    Results::new(Partition::WHOLE, scenes.len(), done, None)
}

/// The run fails, and both verdicts and table name scene, engine and metric.
fn assert_found(results: &Results, metric: &str, scene: &str) {
    assert!(!results.held());
    let of_metric = results.verdicts.iter().filter(|verdict| verdict.metric == metric);
    let mut missed = of_metric.flat_map(|verdict| &verdict.missed);
    assert!(
        missed.any(|run| run.scene == scene && run.engine == Contender::Continuous),
        "{metric} in {scene}: {:#?}",
        results.verdicts
    );
    let table = report::table(results);
    let line = table.lines().find(|line| line.contains("continuous: ") && line.contains(scene));
    assert!(line.is_some(), "{table}");
    assert!(report::html(results).contains("tolerances missed"));
}

/// The continuous engine of an altered stage, all others as they are.
fn altered(
    contender: Contender,
    stage: &Stage,
    tick_s: f64,
    alter: impl Fn(&mut Stage),
) -> Result<Option<Box<dyn Engine>>, OutOfRange> {
    let mut stage = stage.clone();
    if contender == Contender::Continuous {
        alter(&mut stage);
    }
    build(contender, &stage, tick_s)
}

#[test]
fn the_engines_as_they_are_hold_every_bar() {
    let names = [
        "tilt-constant",
        "oblique-60",
        "drop-0.8",
        "corner-07",
        "graze-in",
        "slide",
        "speed-1000",
        "maze-005",
    ];
    let results = results(&names, &Contender::ALL, &build);
    assert!(results.held(), "{}", report::table(&results));
    let n_asked: usize = results.verdicts.iter().map(|verdict| verdict.n_checked).sum();
    assert!(200 < n_asked, "{n_asked}");
}

#[test]
fn scenes_of_two_contacts_and_of_edges_hold_every_bar() {
    let names = [
        "wedge-0.4",
        "wedge-0.4999999",
        "wedge-corner-wall",
        "roll-over-0.001",
        "roll-over-back",
        "roll-over-rolling",
        "step-down-1e-9-0.5",
        "step-up-5e-2-2",
        "slit-1e-6-0.8",
        "slit-1e-3-3",
        "free-end-around",
        "free-end-back",
        "narrow-entry",
        "narrow-closed-1",
    ];
    let results = results(&names, &[Contender::ClosedForm, Contender::Continuous], &build);
    assert!(results.held(), "{}", report::table(&results));
    for metric in [
        "rest error",
        "position error around edges",
        "position error over steps, slits",
        "position error without play",
    ] {
        let verdict = results.verdicts.iter().find(|verdict| verdict.metric == metric).unwrap();
        assert!(4 < verdict.n_checked, "{metric}: {}", verdict.n_checked);
    }
}

/// Each closed form is written for the scenes that it stands in: it would be no truth if it led through a wall or gained energy.
#[test]
fn no_closed_form_leads_through_a_wall_or_gains_energy() {
    use maze_verify::scene::Family::{FreeEnd, Narrow, RollOver, Slit, Step};
    let is_new = |scene: &Scene| matches!(scene.family, FreeEnd | Narrow | RollOver | Slit | Step);
    let all = catalogue().unwrap().into_iter().filter(|scene| scene.truth.is_some() && is_new(scene));
    let all: Vec<(usize, Scene)> = all.enumerate().collect();
    assert!(30 < all.len());
    for scene in run(&all, &[Contender::ClosedForm], &build, &|_| {}).unwrap() {
        for case in &scene.cases {
            let metrics = &case.run(Contender::ClosedForm).unwrap().metrics;
            assert!(metrics.penetration_max < 1.0e-12, "{}: {}", scene.name, metrics.penetration_max);
            assert!(metrics.energy_gain_part < 1.0e-14, "{}: {}", scene.name, metrics.energy_gain_part);
            assert_eq!(metrics.n_tunnels, 0, "{}", scene.name);
        }
    }
}

/// A ball that stays where it is held up, a millionth beside the place where it must rest.
#[test]
fn a_ball_that_rests_at_the_wrong_place_is_found() {
    let broken = |contender: Contender, stage: &Stage, tick_s: f64| {
        altered(contender, stage, tick_s, |stage| {
            let mut walls = stage.board.rectangles().to_vec();
            walls[1].low.y -= 1.0e-6;
            stage.board = Board::from_rectangles(walls).unwrap();
        })
    };
    assert_found(&results(&["wedge-0.4"], &[Contender::Continuous], &broken), "rest error", "wedge-0.4");
}

#[test]
fn an_edge_that_is_missed_by_a_millionth_is_found() {
    let broken = |contender: Contender, stage: &Stage, tick_s: f64| {
        altered(contender, stage, tick_s, |stage| {
            let mut walls = stage.board.rectangles().to_vec();
            walls[0].high.x -= 1.0e-6;
            stage.board = Board::from_rectangles(walls).unwrap();
        })
    };
    for (scene, metric) in [
        ("roll-over-0.2", "position error around edges"),
        ("slit-1e-3-0.8", "position error over steps, slits"),
    ] {
        assert_found(&results(&[scene], &[Contender::Continuous], &broken), metric, scene);
    }
}

#[test]
fn a_restitution_off_by_one_percent_is_found() {
    let broken = |contender: Contender, stage: &Stage, tick_s: f64| {
        altered(contender, stage, tick_s, |stage| stage.scene.spec.restitution *= 0.99)
    };
    let results = results(&["head-on", "drop-0.8"], &[Contender::Continuous], &broken);
    assert_found(&results, "velocity error", "head-on");
    assert_found(&results, "restitution error", "head-on");
    assert_found(&results, "apex error", "drop-0.8");
}

#[test]
fn a_wall_moved_by_a_thousandth_is_found() {
    for (shift, metric) in [(-1.0e-3, "position error"), (1.0e-3, "penetration")] {
        let broken = move |contender: Contender, stage: &Stage, tick_s: f64| {
            altered(contender, stage, tick_s, |stage| {
                let moved = |wall: &Bounds| {
                    let by = Vector2::new(shift, 0.0);
                    Bounds { low: wall.low + by, high: wall.high + by }
                };
                let walls = stage.board.rectangles().iter().map(moved).collect();
                stage.board = Board::from_rectangles(walls).unwrap();
            })
        };
        let results = results(&["head-on"], &[Contender::Continuous], &broken);
        assert_found(&results, metric, "head-on");
    }
}

/// An exact engine that has forgotten corners: faces only, as one may write it first.
struct FacesOnly {
    planes: Vec<Plane>,
    spec: BallSpec,
    ball: Ball,
    tick_s: f64,
}

impl Engine for FacesOnly {
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        _observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        let mut left_s = self.tick_s;
        loop {
            let path =
                maze_core::Path { position: self.ball.position, velocity: self.ball.velocity, acceleration };
            let hits = self.planes.iter().filter_map(|plane| {
                Some((time_of_impact::face(&path, self.spec.radius.units(), plane)?, plane.facing.axis()))
            });
            let first = hits.min_by(|a, b| a.0.total_cmp(&b.0)).filter(|hit| hit.0 < left_s);
            let until_s = first.map_or(left_s, |hit| hit.0);
            self.ball = Ball { position: path.at(until_s), velocity: path.velocity_at(until_s) };
            let Some((_, axis)) = first else { return Ok(Tick::default()) };
            self.ball.velocity[axis] *= -self.spec.restitution;
            left_s -= until_s;
        }
    }

    fn ball(&self) -> Ball {
        self.ball
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        self.ball = ball;
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

#[test]
fn a_forgotten_corner_test_is_found() {
    let broken = |contender: Contender, stage: &Stage, tick_s: f64| {
        if contender != Contender::Continuous {
            return build(contender, stage, tick_s);
        }
        let planes = stage.board.planes();
        let planes = Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).collect();
        let engine = FacesOnly { planes, spec: stage.scene.spec, ball: stage.ball, tick_s };
        Ok(Some(Box::new(engine) as Box<dyn Engine>))
    };
    // It is right where there are faces only, and wrong at a corner.
    assert!(results(&["head-on", "oblique-45"], &[Contender::Continuous], &broken).held());
    let results = results(&["corner-05"], &[Contender::Continuous], &broken);
    for metric in ["velocity error", "angle error", "position error", "penetration"] {
        assert_found(&results, metric, "corner-05");
    }
}

#[test]
fn a_ball_that_goes_through_a_wall_is_found() {
    let broken = |contender: Contender, stage: &Stage, tick_s: f64| {
        altered(contender, stage, tick_s, |stage| {
            let mut walls = stage.board.rectangles().to_vec();
            walls.pop();
            stage.board = Board::from_rectangles(walls).unwrap();
        })
    };
    // The last wall of the hall is the thin one.
    let results = results(&["speed-100"], &[Contender::Continuous], &broken);
    assert_found(&results, "tunnels", "speed-100");
}

#[test]
fn parts_of_a_run_join_to_the_whole() {
    let names = ["tilt-flat", "head-on", "rest", "corner-01", "maze-001"];
    let engines = [Contender::ClosedForm, Contender::Continuous, Contender::RapierCuboids];
    let forget_times = |mut results: Results| {
        for case in results.scenes.iter_mut().flat_map(|scene| &mut scene.cases) {
            case.runs.iter_mut().for_each(|run| run.metrics.ns_per_tick = 0.0);
        }
        results
    };
    let all = scenes(&names);
    let part = |k| {
        let partition = Partition { k, n: 2 };
        let mine: Vec<_> = all.iter().filter(|(index, _)| partition.has(*index)).cloned().collect();
        let done = run(&mine, &engines, &build, &|_| {}).unwrap();
        forget_times(Results::new(partition, all.len(), done, None))
    };
    let (first, second) = (part(1), part(2));
    let whole = forget_times(results(&names, &engines, &build));
    // Through the file format and back.
    let through = |results: &Results| -> Results {
        serde_json::from_str(&serde_json::to_string(results).unwrap()).unwrap()
    };
    assert_eq!(Results::merge(vec![through(&second), through(&first)]), Ok(whole));
    assert_eq!(Results::merge(vec![first.clone()]), Err("part 2/2 is missing".to_owned()));
    assert_eq!(Results::merge(vec![first.clone(), first]), Err("part 1/2 is there twice".to_owned()));
}

/// rapier's contacts begin 0.02 units before the touch. Without this margin, and with fine ticks, it agrees with closed form
/// at corners too: the scenes are the same, and so is the physics.
#[test]
fn at_corners_rapier_without_its_margin_agrees_with_closed_form() {
    let tick_s = 0.001;
    for (_, scene) in scenes(&["corner-01", "corner-04", "corner-07", "corner-10", "graze-in"]) {
        let stage = scene.set_up().unwrap();
        let mut truth = build(Contender::ClosedForm, &stage, tick_s).unwrap().unwrap();
        let mut rapier =
            RapierEngine::new(&stage.board, Walls::Cuboids, scene.spec, stage.ball, tick_s).unwrap();
        rapier.set_prediction_distance(1.0e-4);
        for _ in 0..stage.n_ticks(tick_s) {
            truth.tick(Vector2::zeros()).unwrap();
            rapier.tick(Vector2::zeros()).unwrap();
        }
        // A tick's displacement is 0.003 of a radius of 0.25: the direction of the touch is told to a degree.
        let angle = truth.ball().velocity.angle(&rapier.ball().velocity).to_degrees();
        assert!(angle < 1.0, "{}: {angle} degrees", scene.name);
        let off = (truth.ball().position - rapier.ball().position).norm();
        assert!(off < 0.05, "{}: {off}", scene.name);
    }
}

#[test]
fn the_continuous_engine_is_what_the_run_calls_continuous() {
    let (_, scene) = scenes(&["maze-002"]).remove(0);
    let stage = scene.set_up().unwrap();
    let mut ours = build(Contender::Continuous, &stage, 0.03).unwrap().unwrap();
    let planes = stage.board.planes().clone();
    let mut plain = Continuous::new(planes, scene.spec, stage.ball, 0.03).unwrap();
    for index in 0..300 {
        let acceleration = scene.gravity.of_tick(index, 0.03);
        assert_eq!(ours.tick(acceleration).unwrap(), plain.tick(acceleration).unwrap());
        assert_eq!(ours.ball(), plain.ball());
    }
}
