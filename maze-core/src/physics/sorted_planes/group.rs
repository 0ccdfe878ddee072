//! The faces of one facing: rows of intervals, as ranks of coordinates.

use std::ops::Range;

/// One end of an interval: the rank of its coordinate, and whether it is a corner that a ball can touch.
///
/// The flag stands in the lowest bit, so that ends compare with ranks as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct End(u32);

impl End {
    pub(super) fn new(rank: u32, is_corner: bool) -> Self {
        Self(rank << 1 | u32::from(is_corner))
    }

    pub(super) fn rank(self) -> u32 {
        self.0 >> 1
    }

    pub(super) fn is_corner(self) -> bool {
        self.0 & 1 == 1
    }

    pub(super) fn is_below(self, rank: u32) -> bool {
        self.0 < rank << 1
    }
}

/// A stretch of a row that is wall.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Interval {
    pub(super) start: End,
    pub(super) end: End,
}

/// All faces of one group that share an offset: `intervals[first..last]` of the group.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Row {
    pub(super) offset: f64,
    pub(super) first: u32,
    pub(super) last: u32,
    /// Where its buckets begin in the group's table.
    begin: u32,
    /// Number of its last bucket.
    last_bucket: u32,
    /// Rank of the first interval's end, where the buckets begin.
    base: u32,
    /// A bucket holds so many ranks, as a power of two.
    shift: u32,
}

impl Row {
    pub(super) fn range(&self) -> Range<usize> {
        self.first as usize..self.last as usize
    }
}

/// The faces of one facing.
/// Invariant: offsets ascending; a row's intervals are disjoint, do not touch, and ascend.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    pub(super) rows: Vec<Row>,
    pub(super) intervals: Vec<Interval>,
    /// For each rank across the rows: how many rows lie at lower ones.
    rows_below: Vec<u32>,
    /// For each row its buckets: the first interval whose end lies in the bucket or beyond, and at last the row's end.
    table: Vec<u32>,
}

/// Intervals up to which a row is as well searched from its middle.
const SHORT: u32 = 4;

/// Intervals that share a bucket where they are evenly spread.
const INTERVALS_PER_BUCKET: u32 = 2;

/// A plane before it is sorted in: the ranks of its offset, start and end.
pub(super) type Ranks = [u32; 3];

impl Group {
    /// Sorts, and merges the planes of a row that touch or overlap. `offset` gives the coordinate of a rank across the rows,
    /// of which there are `n_ranks`.
    pub(super) fn new(planes: &[Ranks], n_ranks: usize, offset: impl Fn(u32) -> f64) -> Self {
        // Sorted by offset in one pass over the counts, by start and end row by row: most rows come sorted.
        let mut begins = vec![0_usize; n_ranks + 1];
        for [rank, ..] in planes {
            begins[*rank as usize + 1] += 1;
        }
        for rank in 0..n_ranks {
            begins[rank + 1] += begins[rank];
        }
        let mut keys = vec![0_u64; planes.len()];
        let mut next = begins.clone();
        for &[rank, start, end] in planes {
            let place = &mut next[rank as usize];
            keys[*place] = u64::from(start) << 32 | u64::from(end);
            *place += 1;
        }
        let mut group = Self { rows_below: Vec::with_capacity(n_ranks + 1), ..Self::default() };
        group.intervals.reserve(planes.len());
        group.rows_below.push(0);
        for (rank, pair) in (0..).zip(begins.windows(2)) {
            group.push_row(offset(rank), &mut keys[pair[0]..pair[1]]);
            group.rows_below.push(n_32(group.rows.len()));
        }
        group.rows.shrink_to_fit();
        group.intervals.shrink_to_fit();
        group.list_buckets();
        group
    }

    fn push_row(&mut self, offset: f64, keys: &mut [u64]) {
        keys.sort_unstable();
        let first = self.intervals.len();
        for key in keys {
            #[allow(clippy::cast_possible_truncation, reason = "two halves")]
            let (start, end) = ((*key >> 32) as u32, *key as u32);
            match self.intervals[first..].last_mut() {
                Some(previous) if start <= previous.end.rank() => {
                    if previous.end.rank() < end {
                        previous.end = End::new(end, true);
                    }
                }
                _ => self.intervals.push(Interval { start: End::new(start, true), end: End::new(end, true) }),
            }
        }
        let last = self.intervals.len();
        if first < last {
            self.rows.push(Row { offset, first: n_32(first), last: n_32(last), ..Row::default() });
        }
    }

    /// Gives each row of more than a few intervals a bucket index.
    fn list_buckets(&mut self) {
        for row in &mut self.rows {
            let intervals = &self.intervals[row.range()];
            let n_intervals = row.last - row.first;
            let (Some(lowest), Some(highest)) = (intervals.first(), intervals.last()) else { continue };
            row.base = lowest.end.rank();
            let span = highest.end.rank() - row.base;
            if n_intervals <= SHORT {
                continue;
            }
            while n_intervals / INTERVALS_PER_BUCKET <= span >> row.shift {
                row.shift += 1;
            }
            row.last_bucket = span >> row.shift;
            row.begin = n_32(self.table.len());
            let mut next = row.first;
            for bucket in 0..=row.last_bucket {
                while (self.intervals[next as usize].end.rank() - row.base) >> row.shift < bucket {
                    next += 1;
                }
                self.table.push(next);
            }
            self.table.push(row.last);
        }
        self.table.shrink_to_fit();
    }

    /// Leaves the plain bisection.
    pub(super) fn drop_buckets(&mut self) {
        self.table = Vec::new();
        for row in &mut self.rows {
            row.last_bucket = 0;
        }
    }

    /// Index of the first row at that rank across the rows or a higher one.
    pub(super) fn row_from(&self, rank: u32) -> usize {
        self.rows_below[rank as usize] as usize
    }

    /// The row at a rank.
    pub(super) fn row_at(&self, rank: u32) -> Option<usize> {
        let row = self.row_from(rank);
        (row < self.row_from(rank + 1)).then_some(row)
    }

    /// Index of the row's first interval that does not end below a rank.
    pub(super) fn interval_from(&self, row: &Row, rank: u32) -> usize {
        let part = if row.last_bucket == 0 {
            row.range()
        } else {
            let bucket = rank.saturating_sub(row.base) >> row.shift;
            let bucket = bucket.min(row.last_bucket);
            let entry = row.begin as usize + bucket as usize;
            match self.table.get(entry..entry + 2) {
                Some(&[from, to]) => from as usize..to as usize,
                _ => 0..0,
            }
        };
        part.start + self.intervals[part].partition_point(|interval| interval.end.is_below(rank))
    }
}

/// Counts of rows and intervals fit into 32 bits: there are no more than planes, whose number was checked.
pub(super) fn n_32(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
