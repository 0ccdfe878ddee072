//! Comparisons and conversions that are the same to the bit on every platform.

/// The lesser of two numbers; the first where they are equal or one is NaN. `f64::min` does not say which zero it returns.
#[inline]
pub(crate) fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The greater of two numbers; the first where they are equal or one is NaN. `f64::max` does not say which zero it returns.
#[inline]
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if a < b { b } else { a }
}

/// A count or index as a number.
#[allow(clippy::cast_precision_loss, reason = "what is counted has far fewer than 2^53 members")]
pub(crate) fn to_f64(n: usize) -> f64 {
    n as f64
}
