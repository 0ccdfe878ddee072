//! The distinct numbers that the planes of one axis use, sorted, and where a number stands among them.

use crate::physics::numbers::{greater, lesser};
use std::ops::Range;

/// Coordinates of one axis, ascending: offsets of the planes across it, starts and ends of the planes along it.
///
/// Planes keep the ranks of their coordinates here, so that they are small and compare as whole numbers; a search asks
/// once where its own numbers stand. That is a bisection which a bucket index shortens: the span is split into equal
/// buckets, and the bucket index knows where each begins, so that a bisection searches one bucket instead of the whole list:
/// at one number where they are evenly spread, as a maze's are; at up to all of them where they are not, and then it is
/// the plain bisection. It is an accelerator only: placing a number is a subtraction, a multiplication and a rounding,
/// each of which keeps the order of its arguments under rounding, so what stands in a lower bucket is lower, and the
/// bisection's answer is the same.
#[derive(Clone, Debug, Default)]
pub(super) struct Coordinates {
    /// Invariant: finite and ascending but for the last one, infinity, which ends them.
    values: Vec<f64>,
    /// Rank of the first value in each bucket or beyond; one more entry ends the last bucket.
    buckets: Vec<u32>,
    last_bucket: f64,
    origin: f64,
    buckets_per_unit: f64,
    /// Whether no bucket holds more than one value: then one comparison gives the rank.
    is_single: bool,
}

/// Collects the numbers of one axis and drops most of the repeated ones at once, before anything is sorted.
#[derive(Default)]
pub(super) struct Collector {
    values: Vec<f64>,
    /// The number last seen of each hash; empty while there are few numbers.
    seen: Vec<u64>,
}

/// So many numbers are as well sorted with their repetitions.
const FEW: usize = 1024;

/// Hashes of as many bits: three times as many as a board of 10⁷ planes has lines.
const HASH_BITS: u32 = 14;

impl Collector {
    pub(super) fn push(&mut self, value: f64) {
        if self.seen.is_empty() {
            self.values.push(value);
            if FEW <= self.values.len() {
                // No finite number has these bits.
                self.seen = vec![u64::MAX; 1 << HASH_BITS];
            }
            return;
        }
        let bits = value.to_bits();
        // Fibonacci hashing (Knuth, "The Art of Computer Programming" 3, 6.4).
        let hash = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (u64::BITS - HASH_BITS);
        #[allow(clippy::cast_possible_truncation, reason = "HASH_BITS bits")]
        let seen = &mut self.seen[hash as usize];
        if *seen != bits {
            *seen = bits;
            self.values.push(value);
        }
    }

    pub(super) fn coordinates(self) -> Coordinates {
        Coordinates::new(self.values)
    }
}

/// About as many buckets for each value are spent at most, where they leave no two values in one bucket.
const MOST_BUCKETS: usize = 4;

/// 2⁵² is so large that a number below 2³² added to it is rounded to a whole one.
const ROUNDS_TO_WHOLE: f64 = 4_503_599_627_370_496.0;

impl Coordinates {
    /// Sorts finite numbers and drops the repeated ones.
    fn new(mut values: Vec<f64>) -> Self {
        values.sort_unstable_by(f64::total_cmp);
        values.dedup();
        let n_values = values.len();
        values.push(f64::INFINITY);
        values.shrink_to_fit();
        let mut coordinates = Self { values, ..Self::default() };
        let gaps = coordinates.values[..n_values].windows(2).map(|pair| pair[1] - pair[0]);
        let least = gaps.fold(f64::INFINITY, lesser);
        let span = coordinates.values[n_values.saturating_sub(1)] - coordinates.values[0];
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let wanted = (span / least) as usize;
        let most = MOST_BUCKETS * n_values;
        // A bucket a little narrower than the least gap, for rounding.
        coordinates.list_buckets(if wanted < most { wanted + wanted / 64 + 2 } else { n_values });
        coordinates
    }

    /// Splits the span into so many buckets; one alone leaves the plain bisection.
    pub(super) fn list_buckets(&mut self, n_buckets: usize) {
        let n_values = self.len();
        self.origin = if n_values == 0 { 0.0 } else { self.values[0] };
        // Indices are counted in 32 bits, and converted exactly.
        let last = u32::try_from(n_buckets.saturating_sub(1)).unwrap_or(u32::MAX);
        let per_unit = match n_values {
            0 | 1 => 0.0,
            _ => f64::from(last) / (self.values[n_values - 1] - self.origin),
        };
        // Values too near to be told apart, or too far apart to be subtracted, stay in one bucket.
        let is_split = per_unit.is_finite() && 0.0 < per_unit;
        self.buckets_per_unit = if is_split { per_unit } else { 0.0 };
        let last = if is_split { last } else { 0 };
        self.last_bucket = f64::from(last);
        self.is_single = 0 < n_values;
        self.buckets = vec![0; last as usize + 2];
        let mut next = 0_u32;
        for bucket in 0..=last {
            let first = next;
            self.buckets[bucket as usize] = first;
            while (next as usize) < n_values && self.bucket(self.value(next)) == bucket as usize {
                next += 1;
            }
            self.is_single &= next <= first + 1;
        }
        self.buckets[last as usize + 1] = next;
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.values.len().saturating_sub(1)
    }

    /// The one with that rank.
    pub(super) fn value(&self, rank: u32) -> f64 {
        self.values[rank as usize]
    }

    /// The bucket of any number; the first or last one for numbers beyond the ends.
    fn bucket(&self, value: f64) -> usize {
        let place = (value - self.origin) * self.buckets_per_unit;
        let place = greater(0.0, place);
        let place = lesser(self.last_bucket, place);
        // The nearest whole number, in the lower half of the sum's bits.
        #[allow(clippy::cast_possible_truncation, reason = "the lower half is meant")]
        let bucket = (place + ROUNDS_TO_WHOLE).to_bits() as u32;
        bucket as usize
    }

    /// Number of values of which `is_before` holds, which holds of all below `value` and of none above it.
    #[inline]
    fn rank(&self, value: f64, is_before: impl Fn(f64) -> bool) -> u32 {
        let bucket = self.bucket(value);
        let from = self.buckets[bucket];
        if self.is_single {
            return from + u32::from(is_before(self.values[from as usize]));
        }
        let part = &self.values[from as usize..self.buckets[bucket + 1] as usize];
        #[allow(clippy::cast_possible_truncation, reason = "no more than there are ranks")]
        let n_before = part.partition_point(|known| is_before(*known)) as u32;
        from + n_before
    }

    /// Number of values below a finite number: the rank of the first that is not.
    #[inline]
    pub(super) fn n_below(&self, value: f64) -> u32 {
        self.rank(value, |known| known < value)
    }

    /// Number of values at or below a finite number: the rank of the first above it.
    #[inline]
    pub(super) fn n_not_above(&self, value: f64) -> u32 {
        self.rank(value, |known| known <= value)
    }

    /// Ranks of the values within a closed range.
    #[inline]
    pub(super) fn within(&self, [low, high]: [f64; 2]) -> Range<u32> {
        let from = self.n_below(low);
        // Most often there is none.
        if high < self.values[from as usize] { from..from } else { from..self.n_not_above(high) }
    }

    /// The rank of a number that is one of the values.
    pub(super) fn rank_of(&self, value: f64) -> u32 {
        self.n_below(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn values() -> impl Strategy<Value = Vec<f64>> {
        let value = prop_oneof![
            (-9..9_i32).prop_map(f64::from),
            -10.0..10.0_f64,
            // A cluster, and numbers at the ends of what floats hold.
            (0..9_i32).prop_map(|n| 1.0 + f64::from(n) * f64::EPSILON),
            Just(-f64::MAX),
            Just(f64::MAX),
        ];
        prop::collection::vec(value, 0..60)
    }

    proptest! {
        #[test]
        fn ranks_are_those_of_the_plain_count(
            values in values(),
            n_buckets in prop::option::of(0..200_usize),
            value in prop_oneof![(-10..10_i32).prop_map(f64::from), -12.0..12.0_f64, Just(f64::MAX), Just(-f64::MAX)],
        ) {
            let mut coordinates = Coordinates::new(values);
            if let Some(n_buckets) = n_buckets {
                coordinates.list_buckets(n_buckets);
            }
            let known = &coordinates.values[..coordinates.len()];
            prop_assert!(known.windows(2).all(|pair| pair[0] < pair[1]));
            let n_below = known.iter().filter(|known| **known < value).count();
            let n_not_above = known.iter().filter(|known| **known <= value).count();
            prop_assert_eq!(coordinates.n_below(value) as usize, n_below);
            prop_assert_eq!(coordinates.n_not_above(value) as usize, n_not_above);
            for (rank, known) in (0..).zip(known) {
                prop_assert_eq!(coordinates.rank_of(*known), rank);
            }
        }
    }

    #[test]
    fn without_values_every_rank_is_0() {
        let none = Coordinates::new(Vec::new());
        for value in [0.0, -f64::MAX, f64::MAX, f64::INFINITY] {
            assert_eq!((none.n_below(value), none.n_not_above(value)), (0, 0));
        }
    }

    #[test]
    fn collected_numbers_are_the_distinct_ones_however_often_they_repeat() {
        let mut collector = Collector::default();
        (0..100_000_u32).for_each(|n| collector.push(f64::from(n * 7919 % 20_011)));
        let coordinates = collector.coordinates();
        assert_eq!(coordinates.values[..20_011], (0..20_011).map(f64::from).collect::<Vec<_>>());
        assert_eq!(coordinates.len(), 20_011);
    }

    #[test]
    fn lines_of_a_maze_have_a_bucket_each() {
        let lines = (0..1000_u32).flat_map(|n| [0.0, 0.2].map(|wall| f64::from(n) * 1.2 + wall));
        let coordinates = Coordinates::new(lines.collect());
        assert!(coordinates.is_single);
        assert!(coordinates.buckets.len() < (MOST_BUCKETS + 1) * coordinates.len());
        // Lines that come closer to each other than that are told apart by bisection.
        assert!(!Coordinates::new((0..1000).map(|n| 1.0 / f64::from(n + 1)).collect()).is_single);
    }
}
