//! Numbers that look random and are the same everywhere, for tests and the soak.

#![allow(dead_code, reason = "each test uses a part of it")]

use nalgebra::Vector2;

/// splitmix64 (Steele, Lea, Flood 2014), started at a seed.
pub(crate) struct Noise(pub(crate) u64);

impl Noise {
    /// -1 to 1.
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        #[allow(clippy::cast_precision_loss, reason = "53 bits are kept on purpose")]
        let part = ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 52) as f64;
        part - 1.0
    }

    /// Both coordinates -1 to 1.
    pub(crate) fn vector(&mut self) -> Vector2<f64> {
        let x = self.next();
        Vector2::new(x, self.next())
    }
}
