//! Corner touches against exact arithmetic: rational numbers have no rounding, and Sturm's theorem counts roots for certain.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod noise;

use maze_core::Path;
use maze_core::time_of_impact;
use nalgebra::Vector2;
use noise::Noise;
use num_rational::BigRational as Exact;
use std::ops::Neg;

/// A touch is good to this many roundings of the lengths that go into it, divided by the speed of the approach.
/// One suffices for the touches below.
const ROUNDINGS: f64 = 4.0;

/// The horizon of all searches (s).
const HORIZON_S: f64 = 1.0;

fn exact(value: f64) -> Exact {
    Exact::from_float(value).unwrap()
}

fn zero() -> Exact {
    exact(0.0)
}

/// Coefficients, constant first.
#[derive(Clone)]
struct Polynomial(Vec<Exact>);

impl Polynomial {
    fn at(&self, x: &Exact) -> Exact {
        self.0.iter().rev().fold(zero(), |sum, coefficient| sum * x + coefficient)
    }

    fn derivative(&self) -> Self {
        let term = |(power, coefficient): (u32, &Exact)| coefficient * exact(f64::from(power));
        Self((0..).zip(&self.0).skip(1).map(term).collect())
    }

    fn trimmed(mut self) -> Self {
        while self.0.last().is_some_and(|last| *last == zero()) {
            self.0.pop();
        }
        self
    }

    /// What is left of `self` after division.
    fn remainder(&self, divisor: &Self) -> Self {
        let mut rest = self.clone().trimmed();
        while divisor.0.len() <= rest.0.len() {
            let shift = rest.0.len() - divisor.0.len();
            let factor = rest.0.last().unwrap() / divisor.0.last().unwrap();
            for (power, coefficient) in divisor.0.iter().enumerate() {
                rest.0[shift + power] -= coefficient * &factor;
            }
            rest = rest.trimmed();
        }
        rest
    }

    /// Number of different roots in (from, to], by Sturm's theorem; `from` and `to` are none.
    fn n_roots(&self, from: &Exact, to: &Exact) -> usize {
        let mut chain = vec![self.clone().trimmed(), self.derivative().trimmed()];
        while let [.., before, last] = &chain[..]
            && !last.0.is_empty()
        {
            let next = before.remainder(last).0.into_iter().map(Neg::neg).collect();
            chain.push(Self(next));
        }
        let n_changes = |x: &Exact| {
            let values: Vec<_> = chain.iter().map(|p| p.at(x)).filter(|value| *value != zero()).collect();
            values.windows(2).filter(|pair| (pair[0] < zero()) != (pair[1] < zero())).count()
        };
        n_changes(from) - n_changes(to)
    }
}

/// Squared distance of a path from the origin less the squared radius, as an exact polynomial of the time.
fn excess(path: &Path, radius: f64) -> Polynomial {
    let axis = |axis: usize| {
        let [c, v, a] = [path.position[axis], path.velocity[axis], path.acceleration[axis]].map(exact);
        [c, v, a / exact(2.0)]
    };
    let mut sum = vec![zero(); 5];
    for terms in [axis(0), axis(1)] {
        for (i, one) in terms.iter().enumerate() {
            for (j, other) in terms.iter().enumerate() {
                sum[i + j] += one * other;
            }
        }
    }
    sum[0] -= exact(radius) * exact(radius);
    Polynomial(sum)
}

fn random_case(noise: &mut Noise) -> (Path, f64) {
    let fast = if noise.next() < 0.0 { 1.0 } else { 100.0 };
    let path = Path {
        position: noise.vector() * 5.0,
        velocity: noise.vector() * 3.0 * fast,
        acceleration: noise.vector() * 10.0 * fast,
    };
    // Half of them aimed at the corner, or hardly any would hit.
    let aimed = if noise.next() < 0.0 { -path.position * fast } else { path.velocity };
    (Path { velocity: aimed, ..path }, 0.05 + 0.5 * noise.next().abs())
}

#[test]
fn a_corner_touch_is_the_first_root_to_a_stated_number_of_roundings() {
    let mut noise = Noise(2020);
    let (mut n_touches, mut n_misses) = (0, 0);
    for n in 0..3000 {
        let (path, radius) = random_case(&mut noise);
        if path.position.norm() < radius * 1.001 {
            continue;
        }
        let excess = excess(&path, radius);
        let Some(time_s) = time_of_impact::corner(&path, radius, Vector2::zeros(), HORIZON_S) else {
            // A graze is none: within the radius less 10^-9 of it the path never comes.
            let inner = self::excess(&path, radius * (1.0 - 1.0e-9));
            assert_eq!(inner.n_roots(&zero(), &exact(HORIZON_S)), 0, "case {n}: {path:?}, radius {radius}");
            n_misses += 1;
            continue;
        };
        let at = path.at(time_s);
        let approach = -at.dot(&path.velocity_at(time_s)) / radius;
        let lengths = path.position.norm()
            + (path.velocity.norm() + path.acceleration.norm() * time_s) * time_s
            + radius;
        let bound_s = f64::EPSILON * (ROUNDINGS * lengths / approach + time_s);
        // Near a graze the slope changes within the bound, and the bound says nothing.
        if approach < 1.0e-4 * path.velocity_at(time_s).norm() {
            continue;
        }
        let [before, after] = [exact(time_s - bound_s), exact(time_s + bound_s)];
        assert!(zero() < excess.at(&before), "case {n}: {time_s} is too late, {path:?}, radius {radius}");
        assert!(excess.at(&after) < zero(), "case {n}: {time_s} is too early, {path:?}, radius {radius}");
        if zero() < before {
            assert_eq!(excess.n_roots(&zero(), &before), 0, "case {n}: there is an earlier touch");
        }
        n_touches += 1;
    }
    assert!(500 < n_touches && 500 < n_misses, "{n_touches} touches, {n_misses} misses");
}

#[test]
fn sturms_theorem_counts_roots() {
    // (x - 1)(x - 2)(x² + 1)
    let polynomial = Polynomial([2.0, -3.0, 3.0, -3.0, 1.0].map(exact).to_vec());
    let count = |from: f64, to: f64| polynomial.n_roots(&exact(from), &exact(to));
    assert_eq!([count(0.0, 3.0), count(0.0, 1.5), count(2.5, 9.0), count(-9.0, 0.5)], [2, 1, 0, 0]);
}
