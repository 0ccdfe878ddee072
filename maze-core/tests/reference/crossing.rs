//! When a polynomial first falls below zero: by halving, with the bounds that Bernstein's coefficients are.

use super::big::{Big, big};
use std::cmp::Ordering;

/// Halvings of the time at most: 2e-36 of it.
const HALVINGS: u32 = 118;

/// The first time in `0..=horizon` at which a polynomial (constant term first) that begins above zero falls below it. One that
/// touches zero and rises again does not.
pub(crate) fn quartic(power: &[Big; 5], horizon: &Big) -> Option<Big> {
    // 12 b_i = sum over j <= i of C(i, j) (12 / C(4, j)) c_j T^j.
    const PARTS: [f64; 5] = [12.0, 3.0, 2.0, 3.0, 12.0];
    const BINOMIALS: [[f64; 5]; 5] = [
        [1.0, 0.0, 0.0, 0.0, 0.0],
        [1.0, 1.0, 0.0, 0.0, 0.0],
        [1.0, 2.0, 1.0, 0.0, 0.0],
        [1.0, 3.0, 3.0, 1.0, 0.0],
        [1.0, 4.0, 6.0, 4.0, 1.0],
    ];
    let mut scale = big(1.0);
    let scaled: [Big; 5] = std::array::from_fn(|j| {
        let term = &power[j] * &scale * big(PARTS[j]);
        scale = &scale * horizon;
        term
    });
    let bernstein = BINOMIALS.map(|row| {
        let terms = row.iter().zip(&scaled).filter(|(factor, _)| **factor != 0.0);
        terms.fold(big(0.0), |sum, (factor, term)| sum + big(*factor) * term)
    });
    first_below(bernstein, &big(0.0), horizon, HALVINGS)
}

/// The curve lies within the hull of its coefficients: where none is negative, neither is the curve.
fn first_below(b: [Big; 5], from: &Big, width: &Big, halvings: u32) -> Option<Big> {
    let is_negative = |value: &Big| value.sign() == Ordering::Less;
    if !b.iter().any(is_negative) {
        return None;
    }
    if halvings == 0 {
        return is_negative(&b[4]).then(|| from.clone());
    }
    // De Casteljau: the first of each row is the left half's, the last the right half's.
    let (mut left, mut right, mut row) = (b.clone(), b.clone(), b.to_vec());
    for n in 1..5 {
        row = row.windows(2).map(|pair| (&pair[0] + &pair[1]).half()).collect();
        left[n] = row[0].clone();
        right[4 - n] = row[row.len() - 1].clone();
    }
    let width = width.clone().half();
    first_below(left, from, &width, halvings - 1)
        .or_else(|| first_below(right, &(from + &width), &width, halvings - 1))
}

/// The time after 0 at which `gap + v t + a t² / 2` falls below zero; of a gap of 0 the time at which it is 0 again.
/// There is one at most: a parabola falls through zero once.
pub(crate) fn parabola(gap: &Big, v: &Big, a: &Big, zero: &Big) -> Option<Big> {
    let is_touching = gap.abs() < *zero;
    let gap = if is_touching { &big(0.0) } else { gap };
    if is_touching && v.abs() < *zero {
        return None;
    }
    let square = v * v - big(2.0) * a * gap;
    if square.sign() != Ordering::Greater {
        return None;
    }
    let root = square.sqrt();
    if v.sign() == Ordering::Less {
        return (gap.sign() == Ordering::Greater).then(|| big(2.0) * gap / (root - v));
    }
    (a.sign() == Ordering::Less).then(|| (v + root) / -a)
}
