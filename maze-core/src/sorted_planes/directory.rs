//! Where in a sorted list a bisection begins.

use std::ops::Range;

/// Splits the span of a sorted list of numbers into equal buckets and knows which of the list fall into each.
///
/// A bisection for a number then looks at one bucket instead of the whole list: at about one number where they are evenly
/// spread, as a maze's offsets are; at up to all of them where they are not, and then it is the plain bisection. It is an
/// accelerator only: placing a number is a subtraction, a multiplication and a conversion, each of which keeps the order
/// of its arguments under rounding, so what stands in a lower bucket is lower, and the bisection's answer is the same.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Directory {
    origin: f64,
    buckets_per_unit: f64,
    /// Number of the last bucket.
    last: u32,
    /// Where in the table its buckets begin.
    begin: u32,
}

impl Directory {
    /// Numbers up to which a list is as well searched from its middle.
    const SHORT: usize = 4;

    /// Appends a directory of `keys[within]` (ascending and finite) to the table that it shares with others.
    ///
    /// Each entry is the index of the first key in its bucket or beyond; one more entry ends the last bucket.
    pub(super) fn append(
        table: &mut Vec<u32>,
        within: Range<u32>,
        n_buckets: u32,
        key: impl Fn(u32) -> f64,
    ) -> Self {
        let begin = table.len();
        let mut directory = Self { begin: u32::try_from(begin).unwrap_or(u32::MAX), ..Self::default() };
        if Self::SHORT < within.len() && 1 < n_buckets {
            directory.origin = key(within.start);
            let per_unit = f64::from(n_buckets - 1) / (key(within.end - 1) - directory.origin);
            // Keys too near to be told apart stay in one bucket.
            if per_unit.is_finite() {
                directory.buckets_per_unit = per_unit;
                directory.last = n_buckets - 1;
            }
        }
        let mut next = within.start;
        for bucket in 0..=directory.last {
            while next < within.end && directory.bucket(key(next)) < bucket {
                next += 1;
            }
            table.push(next);
        }
        table.push(within.end);
        directory
    }

    /// The bucket of any number; the first or last one for numbers beyond the ends.
    fn bucket(&self, value: f64) -> u32 {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "saturates, which keeps the order"
        )]
        let bucket = ((value - self.origin) * self.buckets_per_unit) as u32;
        if bucket < self.last { bucket } else { self.last }
    }

    /// The part of the list in which the first key that is not less than `value` stands, or right after which.
    pub(super) fn narrow(&self, table: &[u32], value: f64) -> Range<usize> {
        let entry = self.begin as usize + self.bucket(value) as usize;
        match table.get(entry..entry + 2) {
            Some(&[from, to]) => from as usize..to as usize,
            _ => 0..0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn keys() -> impl Strategy<Value = Vec<f64>> {
        let key = prop_oneof![
            (-9..9_i32).prop_map(f64::from),
            -10.0..10.0_f64,
            // A cluster, and numbers at the ends of what floats hold.
            (0..9_i32).prop_map(|n| 1.0 + f64::from(n) * f64::EPSILON),
            Just(-f64::MAX),
            Just(f64::MAX),
        ];
        prop::collection::vec(key, 0..60).prop_map(|mut keys| {
            keys.sort_by(f64::total_cmp);
            keys
        })
    }

    proptest! {
        #[test]
        fn narrowed_bisection_gives_what_the_plain_one_gives(
            keys in keys(),
            n_buckets in 0..200_u32,
            value in prop_oneof![(-10..10_i32).prop_map(f64::from), -12.0..12.0_f64, Just(f64::MAX), Just(-f64::MAX)],
        ) {
            let mut table = vec![7]; // another directory's
            let n_keys = u32::try_from(keys.len()).unwrap();
            let directory = Directory::append(&mut table, 0..n_keys, n_buckets, |n| keys[n as usize]);
            let part = directory.narrow(&table, value);
            let narrowed = part.start + keys[part].partition_point(|key| *key < value);
            prop_assert_eq!(narrowed, keys.partition_point(|key| *key < value));
        }
    }

    #[test]
    fn evenly_spread_numbers_have_a_bucket_each() {
        let mut table = Vec::new();
        let directory = Directory::append(&mut table, 0..1000, 1000, f64::from);
        assert!((0..1000).all(|n| directory.narrow(&table, f64::from(n)).len() <= 2));
    }
}
