//! When a parabola falls through zero, and when the squared distance along one does.

/// The time at which `gap + speed t + acceleration t² / 2` falls through zero, `None` when it never does.
///
/// A quadratic falls through zero at most once. Degenerate cases: already at zero and falling, or at rest there under an
/// acceleration below zero, gives 0; touching from above without falling through (a double root) gives `None`; a start
/// below zero gives the later fall after a rise, or `None`. May return a time just before 0 by rounding only when `gap` is
/// below zero; such times are not returned.
///
/// Of the two forms of the root the one that adds numbers of equal sign is taken, so nothing cancels (Press et al.,
/// "Numerical Recipes", 5.6).
pub(crate) fn falls_through_zero(gap: f64, speed: f64, acceleration: f64) -> Option<f64> {
    let (square, product) = (speed * speed, 2.0 * acceleration * gap);
    if square < SMALLEST && product.abs() < SMALLEST && (speed != 0.0 || acceleration * gap != 0.0) {
        return falls_slowly(gap, speed, acceleration);
    }
    let discriminant = square - product;
    if discriminant < 0.0 {
        return None;
    }
    // At the root the speed is -sqrt(discriminant), whichever root it is.
    let fall = discriminant.sqrt();
    if speed < 0.0 {
        let time = 2.0 * gap / (fall - speed);
        return (0.0 <= time && 0.0 < fall).then_some(time);
    }
    if acceleration < 0.0 {
        let time = (speed + fall) / -acceleration;
        // At rest on zero and pressed, or risen from zero or below and fallen back; not a touch from below.
        return (0.0 < fall || gap == 0.0).then_some(time);
    }
    None
}

/// Squares of speeds below this lose digits, or are 0 (denormal floats begin at 2e-308).
const SMALLEST: f64 = 1.0e-280;

/// 2⁵⁰⁰: a power of two multiplies without rounding.
const LARGE: f64 = 3.273_390_607_896_142e150;

/// [`falls_through_zero`] where squares underflow: gap, speed and acceleration times one factor fall at the same time.
#[cold]
fn falls_slowly(gap: f64, speed: f64, acceleration: f64) -> Option<f64> {
    if gap == 0.0 {
        // At zero: the fall begins at once, or after a rise.
        return match () {
            () if speed < 0.0 => Some(0.0),
            () if acceleration < 0.0 => Some(2.0 * speed / -acceleration),
            () => None,
        };
    }
    falls_through_zero(gap * LARGE, speed * LARGE, acceleration * LARGE)
}

/// Most steps of a bracketed Newton iteration: bisection alone reaches neighbouring numbers in about this many.
const MAX_STEPS: u32 = 80;

/// The root of a function that changes its sign between `low` and `high`, by Newton's method kept within the bracket.
///
/// `function` gives value and derivative. Returns the last iterate, good to the rounding of the function.
pub(crate) fn bracketed_root(mut low: f64, mut high: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let falling = 0.0 < function(low).0;
    let mut x = low + (high - low) / 2.0;
    for _ in 0..MAX_STEPS {
        let (value, slope) = function(x);
        if value == 0.0 {
            return x;
        }
        if (0.0 < value) == falling {
            low = x;
        } else {
            high = x;
        }
        let newton = x - value / slope;
        // A step below rounding is the end: the bracket, one end of which is x, would only halve itself around it.
        if (newton - x).abs() <= f64::EPSILON * x.abs() {
            return x;
        }
        let next = if low < newton && newton < high { newton } else { low + (high - low) / 2.0 };
        if next <= low || high <= next {
            return next;
        }
        x = next;
    }
    x
}

/// The roots of `a x² + b x + c` within `low..high`, ascending; for `a = 0` the one of the straight line.
pub(crate) fn quadratic_roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    if a == 0.0 {
        return [(b != 0.0).then(|| -c / b), None];
    }
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return [None, None];
    }
    let root = discriminant.sqrt();
    let q = -0.5 * (b + if b < 0.0 { -root } else { root });
    let (one, other) = (q / a, if q == 0.0 { q / a } else { c / q });
    if one < other { [Some(one), Some(other)] } else { [Some(other), Some(one)] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_degenerate_fall_is_as_stated() {
        let cases = [
            ("straight", (2.0, -1.0, 0.0), Some(2.0)),
            ("straight away", (2.0, 1.0, 0.0), None),
            ("at rest without acceleration", (0.0, 0.0, 0.0), None),
            ("at rest and pressed", (0.0, 0.0, -2.0), Some(0.0)),
            ("at rest and pulled off", (0.0, 0.0, 2.0), None),
            ("touching and closing", (0.0, -1.0, 5.0), Some(0.0)),
            ("touching, thrown up, falls back", (0.0, 3.0, -2.0), Some(3.0)),
            ("grazing from above", (1.0, -2.0, 2.0), None),
            ("turns before it", (1.1, -2.0, 2.0), None),
            ("falls from rest", (4.0, 0.0, -2.0), Some(2.0)),
            ("below, rises and falls", (-1.0, 3.0, -4.0), Some(1.0)),
            ("below, does not reach zero", (-2.0, 1.0, -4.0), None),
            ("below and falling", (-1.0, -1.0, 0.0), None),
            ("below and rising", (-1.0, 1.0, 0.0), None),
        ];
        for (name, (gap, speed, acceleration), expected) in cases {
            assert_eq!(falls_through_zero(gap, speed, acceleration), expected, "{name}");
        }
    }

    #[test]
    fn nothing_cancels_when_the_acceleration_is_tiny() {
        let time = falls_through_zero(1.0, -1.0, 1.0e-17).unwrap();
        assert!((time - 1.0).abs() < 1.0e-15);
        let time = falls_through_zero(1.0e-12, -1.0e6, -9.81).unwrap();
        assert!((time / 1.0e-18 - 1.0).abs() < 1.0e-15);
    }

    #[test]
    fn bracketed_newton_finds_the_root_of_a_steep_and_of_a_flat_function() {
        let cube = |x: f64| (x * x * x - 2.0, 3.0 * x * x);
        assert!((bracketed_root(0.0, 100.0, cube) - 1.259_921_049_894_873_2).abs() < 1.0e-15);
        let flat = |x: f64| ((x - 1.0) * (x - 1.0) * (x - 1.0), 3.0 * (x - 1.0) * (x - 1.0));
        assert!((bracketed_root(0.0, 3.0, flat) - 1.0).abs() < 1.0e-5);
    }

    #[test]
    fn quadratic_roots_ascend() {
        assert_eq!(quadratic_roots(1.0, -3.0, 2.0), [Some(1.0), Some(2.0)]);
        assert_eq!(quadratic_roots(-1.0, 3.0, -2.0), [Some(1.0), Some(2.0)]);
        assert_eq!(quadratic_roots(0.0, 2.0, -4.0), [Some(2.0), None]);
        assert_eq!(quadratic_roots(1.0, 0.0, 1.0), [None, None]);
        assert_eq!(quadratic_roots(1.0, 0.0, 0.0), [Some(0.0), Some(0.0)]);
    }
}
