//! Rolling around a point as a Taylor series: n' = w J n, w' = a . J n / r, where n is the direction from the point to the
//! centre and J turns by a quarter.

use super::big::{Big, Pair, big};

/// Terms: with a step of an eighth of the fastest rate the first one that is left out is 8^-36 = 3e-33.
const ORDER: usize = 36;

/// A stretch of rolling, in fractions of its length.
pub(crate) struct Series {
    terms: [Vec<Big>; 3], // n.x, n.y, w.
    /// How long it is (s).
    pub(crate) step_s: Big,
}

impl Series {
    pub(crate) fn new(n: &Pair, turn: &Big, a: &Pair, r: &Big) -> Self {
        let acceleration = (a[0].f64().powi(2) + a[1].f64().powi(2)).sqrt();
        let rate = turn.f64().abs().max((acceleration / r.f64()).sqrt()).max(1.0e-3);
        let step_s = big(0.125 / rate);
        let (mut x, mut y, mut w) = (vec![n[0].clone()], vec![n[1].clone()], vec![turn.clone()]);
        let (ax, ay) = (&a[0] / r, &a[1] / r);
        let product = |f: &[Big], g: &[Big]| {
            f.iter().zip(g.iter().rev()).fold(big(0.0), |sum, (one, other)| sum + one * other)
        };
        for k in 0..ORDER {
            let part = &step_s / big((k + 1) as f64);
            let (dx, dy) = (-product(&w, &y), product(&w, &x));
            w.push((&ay * &x[k] - &ax * &y[k]) * &part);
            x.push(dx * &part);
            y.push(dy * &part);
        }
        Self { terms: [x, y, w], step_s }
    }

    /// Direction and turning rate after a fraction of the step.
    pub(crate) fn at(&self, fraction: &Big) -> (Pair, Big) {
        let sum = |terms: &[Big]| terms.iter().rev().fold(big(0.0), |sum, term| sum * fraction + term);
        ([sum(&self.terms[0]), sum(&self.terms[1])], sum(&self.terms[2]))
    }
}
