//! Carlson's symmetric elliptic integral of the first kind, by + - * / and square roots alone.

/// Distance of the arguments from their mean, as a fraction of it, at which the series takes over: what the series leaves out
/// is of its sixth power, 1e-16 here.
const CLOSE: f64 = 2.0e-3;

/// Most duplications. Each draws a large ratio of arguments to its square root and brings near ones four times nearer: a ratio
/// of 10³⁰⁰ takes about twenty.
const MAX_DUPLICATIONS: u32 = 40;

/// R_F(x, y, z) = 1/2 ∫₀^∞ dt / √((t + x)(t + y)(t + z)), to a few roundings.
///
/// Needs finite arguments of 0 or more, at most one of them 0. By duplication (Carlson 1979, "Computing elliptic integrals by
/// duplication"; DLMF 19.36.1 for the series).
pub(crate) fn r_f(x: f64, y: f64, z: f64) -> f64 {
    let (mut x, mut y, mut z) = (x, y, z);
    for _ in 0..MAX_DUPLICATIONS {
        let mean = (x + y + z) / 3.0;
        let (dx, dy, dz) = (1.0 - x / mean, 1.0 - y / mean, 1.0 - z / mean);
        if dx.abs() < CLOSE && dy.abs() < CLOSE && dz.abs() < CLOSE {
            let (second, third) = (dx * dy - dz * dz, dx * dy * dz);
            let series =
                1.0 - second / 10.0 + third / 14.0 + second * second / 24.0 - 3.0 * second * third / 44.0;
            return series / mean.sqrt();
        }
        let (root_x, root_y, root_z) = (x.sqrt(), y.sqrt(), z.sqrt());
        let shift = root_x * root_y + root_x * root_z + root_y * root_z;
        (x, y, z) = ((x + shift) / 4.0, (y + shift) / 4.0, (z + shift) / 4.0);
    }
    1.0 / ((x + y + z) / 3.0).sqrt()
}

#[cfg(test)]
#[allow(clippy::disallowed_methods, reason = "the truth that a test compares with may use any function")]
mod tests {
    use super::*;

    #[test]
    fn equal_arguments_give_the_inverse_root() {
        for x in [1.0e-300, 0.25, 7.0, 1.0e300] {
            assert!((r_f(x, x, x) * x.sqrt() - 1.0).abs() < 1.0e-15);
        }
    }

    #[test]
    fn values_of_the_published_table() {
        // Carlson 1995, "Numerical computation of real or complex elliptic integrals", section 3, real arguments; its 14
        // digits continued to 17.
        for ([x, y, z], exact) in [
            ([1.0, 2.0, 0.0], 1.311_028_777_146_059_8),
            ([0.5, 1.0, 0.0], 1.854_074_677_301_371_8),
            ([2.0, 3.0, 4.0], 0.584_082_841_677_151_7),
        ] {
            assert!((r_f(x, y, z) / exact - 1.0).abs() < 5.0e-16, "{x} {y} {z}: {}", r_f(x, y, z));
        }
    }

    #[test]
    fn degenerate_arguments_give_logarithms_and_arcs() {
        // s R_F(1 - s², 1, 1) = asin(s) ... and s R_F(1, 1 + m s², 1) = asinh(√m s) / √m, up to ratios of 10²⁰⁰.
        for s in [1.0e-9_f64, 0.1, 0.7] {
            assert!((s * r_f(1.0 - s * s, 1.0, 1.0) / s.asin() - 1.0).abs() < 1.0e-15);
            for m in [1.0e-3_f64, 1.0, 1.0e12, 1.0e200] {
                let root = m.sqrt();
                let exact = (root * s).asinh() / root;
                let ours = s * r_f(1.0, 1.0 + m * s * s, 1.0);
                assert!((ours / exact - 1.0).abs() < 2.0e-15, "s {s}, m {m}: {ours} instead of {exact}");
            }
        }
    }
}
