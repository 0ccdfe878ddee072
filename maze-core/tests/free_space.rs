//! Ticks that need no search, because the ball stays where nothing is touched, against the same ticks searched.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod noise;

use maze_core::{
    AssembleOptions, Ball, BallSpec, Continuous, Engine, Facing, Plane, Radius, SortedPlanes, layout,
};
use nalgebra::Vector2;
use noise::Noise;
use std::sync::Arc;

/// Accelerations as they come in play: steady ones, straight ones that press the ball onto walls, none at all, sudden turns.
fn next_acceleration(noise: &mut Noise, n: u32, now: Vector2<f64>) -> Vector2<f64> {
    if !n.is_multiple_of(40) {
        return now;
    }
    let next = noise.vector() * 5.0;
    match n / 40 % 5 {
        0 => Vector2::new(next.x, 0.0),
        1 => Vector2::new(0.0, next.y),
        2 => Vector2::zeros(),
        3 => next * 0.01,
        _ => next,
    }
}

/// Both engines must tell and do the same, to the bit.
fn compare(planes: &Arc<SortedPlanes>, spec: BallSpec, start: Vector2<f64>, seed: u64) -> u32 {
    let make = || Continuous::new(planes.clone(), spec, Ball::at(start), 0.03).unwrap();
    let (mut usual, mut searched) = (make(), make().without_cache());
    let (mut noise, mut acceleration, mut n_rests) = (Noise(seed), Vector2::zeros(), 0);
    for n in 0..20_000 {
        acceleration = next_acceleration(&mut noise, n, acceleration);
        // Let go for one tick now and then, so that its support changes while it slides.
        let acceleration = if n % 9 == 8 { Vector2::zeros() } else { acceleration };
        let tick = usual.tick(acceleration).unwrap();
        assert_eq!(tick, searched.tick(acceleration).unwrap(), "tick {n}, seed {seed}");
        let bits = |ball: Ball| [ball.position, ball.velocity].map(|v| [v.x.to_bits(), v.y.to_bits()]);
        assert_eq!(bits(usual.ball()), bits(searched.ball()), "after tick {n}, seed {seed}");
        n_rests += tick.n_rests;
    }
    n_rests
}

#[test]
fn a_tick_without_a_search_is_the_searched_one_to_the_bit() {
    let mut n_rests = 0;
    for (seed, radius) in (0..20).zip([0.35, 0.25, 0.1, 0.49].into_iter().cycle()) {
        let layout = layout::recursive_backtracker(8, 6, seed).unwrap();
        let maze = layout.maze(&AssembleOptions::default()).unwrap();
        let radius = Radius::new(radius).unwrap();
        let spec = BallSpec { radius, ..BallSpec::default() };
        n_rests += compare(&maze.planes, spec, maze.start(), seed);
    }
    assert!(300 < n_rests, "{n_rests} rests: too few to have tried sliding");
}

#[test]
fn it_is_so_among_walls_without_thickness() {
    for seed in 0..20 {
        let mut noise = Noise(1000 + seed);
        let mut lines = Vec::new();
        for n in 0..30 {
            #[allow(clippy::cast_possible_truncation, reason = "-5 to 5")]
            let [offset, start] = [noise.next(), noise.next()].map(|value| f64::from((value * 5.0) as i32));
            let sides =
                if n % 2 == 0 { [Facing::PlusX, Facing::MinusX] } else { [Facing::PlusY, Facing::MinusY] };
            lines.extend(sides.map(|facing| Plane { facing, offset, start, end: start + 2.0 }));
        }
        // A box around them all, so that the ball stays among them.
        for (facing, offset) in
            [(Facing::PlusX, -7.0), (Facing::MinusX, 7.0), (Facing::PlusY, -7.0), (Facing::MinusY, 7.0)]
        {
            lines.push(Plane { facing, offset, start: -7.0, end: 7.0 });
        }
        let planes = Arc::new(SortedPlanes::new(lines).unwrap());
        compare(&planes, BallSpec::default(), Vector2::new(6.5, 6.5), seed);
    }
}
