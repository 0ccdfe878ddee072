//! Where walls keep the sky's light from the floor: their tops drawn into a map once a maze, and blurred.

use maze_core::surface::{Surface, SurfaceMesh};

use crate::light::Bounds;

/// Finest map, in texels per maze unit: the narrow blur is then a little over a texel.
const TEXELS_PER_UNIT: f32 = 24.0;

/// Longest side of the map. A board of 64 units is the first to get a coarser one; a big board's pixels are coarse too.
const MAX_SIDE: f32 = 1536.0;

/// Blurs (standard deviation, maze units): the soft darkness a wall casts about itself, and a rounded edge's width.
const BLURS: [f32; 2] = [0.24, 0.03];

/// Room around the board, so that the wide blur fades out inside the map.
const MARGIN: f32 = 0.75;

/// Most rows of texels that are visited for all triangles together: 0.3 s at 10 ns each. Triangles that do not overlap
/// and are a texel wide come to 2 `MAX_SIDE`² = 4.7 million, since a triangle's height is twice its area over its width.
const MAX_ROW_VISITS: usize = 1 << 25;

/// Two bytes a texel: the wide blur and the narrow one, 255 where all is wall.
pub(crate) struct OcclusionMap {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) texels: Vec<[u8; 2]>,
    /// Map coordinates from maze x and y: scale, then offset.
    pub(crate) uv_from_maze: [f32; 4],
}

impl OcclusionMap {
    /// Memory and time grow with the map's area, and with the triangles' heights up to [`MAX_ROW_VISITS`]: of triangles
    /// that come after that many rows, the ones that need more than what is left are not in the map.
    pub(crate) fn new(mesh: &SurfaceMesh, bounds: &Bounds) -> Self {
        let texels_per_unit = TEXELS_PER_UNIT.min(MAX_SIDE / (bounds.extent() + 2.0 * MARGIN));
        let origin = [bounds.min[0] - MARGIN, bounds.min[1] - MARGIN];
        let side = |axis: usize| {
            let units = bounds.max[axis] + MARGIN - origin[axis];
            to_index((units * texels_per_unit).ceil()).max(1)
        };
        let mut walls = Coverage::new(side(0), side(1), MAX_ROW_VISITS);
        for triangle in mesh.indices_of(Surface::Top).as_chunks::<3>().0 {
            let corners = triangle.map(|i| {
                let [x, y, _] = mesh.vertices[i as usize].position;
                [(x - origin[0]) * texels_per_unit, (y - origin[1]) * texels_per_unit]
            });
            walls.add(corners);
        }
        let walls = walls.into_grid();
        let [wide, narrow] = BLURS.map(|sigma| walls.blurred(sigma * texels_per_unit));
        let texels =
            wide.values.iter().zip(&narrow.values).map(|(&w, &n)| [to_byte(w), to_byte(n)]).collect();
        let scale = [texels_per_unit / walls.width as f32, texels_per_unit / walls.height as f32];
        Self {
            width: u32::try_from(walls.width).unwrap_or(1),
            height: u32::try_from(walls.height).unwrap_or(1),
            texels,
            uv_from_maze: [scale[0], scale[1], -origin[0] * scale[0], -origin[1] * scale[1]],
        }
    }
}

/// Which texels triangles cover, collected row by row as changes of their number from a texel to the next. So a row
/// costs the same however wide it is, and however many triangles lie on top of each other.
struct Coverage {
    width: usize,
    height: usize,
    /// One more a row than texels: where a span that reaches the end is closed.
    changes: Vec<i32>,
    n_rows_left: usize,
}

impl Coverage {
    fn new(width: usize, height: usize, max_row_visits: usize) -> Self {
        Self { width, height, changes: vec![0; (width + 1) * height], n_rows_left: max_row_visits }
    }

    /// Covers the texels whose centre lies in a triangle (either way round), in texel coordinates; false, and nothing
    /// covered, where that takes more rows than are left. Triangles that share an edge leave no gap.
    fn add(&mut self, [a, b, c]: [[f32; 2]; 3]) -> bool {
        // From the first centre at or after `low` to the last one at or before `high`.
        let centres = |low: f32, high: f32, n: usize| {
            to_index((low - 0.5).ceil()).min(n)..to_index((high + 0.5).floor()).min(n)
        };
        let rows = centres(a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]), self.height);
        let Some(n_rows_left) = self.n_rows_left.checked_sub(rows.len()) else { return false };
        self.n_rows_left = n_rows_left;
        // Always upwards: an edge then is at the same place, to the last bit, for both triangles that share it.
        let edges =
            [(a, b), (b, c), (c, a)].map(|(p, q)| if (p[1], p[0]) < (q[1], q[0]) { (p, q) } else { (q, p) });
        for row in rows {
            let y = row as f32 + 0.5;
            let crossed = edges.iter().filter(|(p, q)| p[1] <= y && y <= q[1]);
            let (low, high) = crossed.fold((f32::MAX, f32::MIN), |(low, high), (p, q)| {
                // A level edge is crossed in all its length.
                let at = if p[1] < q[1] { p[0] + (q[0] - p[0]) * ((y - p[1]) / (q[1] - p[1])) } else { p[0] };
                let end = if p[1] < q[1] { at } else { q[0] };
                (low.min(at).min(end), high.max(at).max(end))
            });
            let span = centres(low, high, self.width);
            if !span.is_empty() {
                let start = row * (self.width + 1);
                self.changes[start + span.start] += 1;
                self.changes[start + span.end] -= 1;
            }
        }
        true
    }

    /// 1 where any triangle covers a texel, 0 elsewhere.
    fn into_grid(self) -> Grid {
        let mut values = Vec::with_capacity(self.width * self.height);
        for row in self.changes.chunks_exact(self.width + 1) {
            let mut n_covering = 0;
            values.extend(row[..self.width].iter().map(|change| {
                n_covering += change;
                if 0 < n_covering { 1.0 } else { 0.0 }
            }));
        }
        Grid { width: self.width, height: self.height, values }
    }
}

struct Grid {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Grid {
    /// Three box blurs along each axis: within 3 percent of a Gaussian.
    fn blurred(&self, sigma: f32) -> Self {
        // Variance of a box of n texels is (n^2 - 1) / 12; three add up.
        let radius = to_index(0.5 * ((4.0 * sigma * sigma + 1.0).sqrt() - 1.0) + 0.5);
        let mut values = self.values.clone();
        for _ in 0..3 {
            values = blur_rows_and_transpose(&values, self.width, radius);
            values = blur_rows_and_transpose(&values, self.height, radius);
        }
        Self { width: self.width, height: self.height, values }
    }
}

/// Means over `2 radius + 1` neighbours in each row (nothing beyond its ends), with rows and columns swapped.
fn blur_rows_and_transpose(values: &[f32], width: usize, radius: usize) -> Vec<f32> {
    let height = values.len() / width;
    let weight = 1.0 / (2 * radius + 1) as f32;
    let mut swapped = vec![0.0; values.len()];
    for (y, row) in values.chunks_exact(width).enumerate() {
        let mut sum: f32 = row.iter().take(radius).sum();
        for x in 0..width {
            sum += row.get(x + radius).copied().unwrap_or(0.0);
            swapped[x * height + y] = sum * weight;
            sum -= x.checked_sub(radius).map_or(0.0, |gone| row[gone]);
        }
    }
    swapped
}

/// Rounds down; negative and not-a-number give 0.
fn to_index(value: f32) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates, as documented")]
    let index = value as usize;
    index
}

fn to_byte(value: f32) -> u8 {
    u8::try_from(to_index(value * 255.0 + 0.5)).unwrap_or(u8::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDES: [usize; 2] = [19, 14];

    fn covered(triangles: &[[[f32; 2]; 3]]) -> Grid {
        let mut coverage = Coverage::new(SIDES[0], SIDES[1], usize::MAX);
        assert!(triangles.iter().all(|&triangle| coverage.add(triangle)));
        coverage.into_grid()
    }

    /// Points in and around the grid, on quarters of texels so that centres fall on edges too.
    fn points() -> impl FnMut() -> [f32; 2] {
        let mut state = 1_u32;
        move || {
            [24, 20].map(|n_texels: u16| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let quarters = u16::try_from(state >> 16).unwrap() % (4 * n_texels);
                f32::from(quarters) / 4.0 - 3.0
            })
        }
    }

    /// How far inside a triangle a point is, as twice an area; negative outside.
    fn depth([a, b, c]: [[f32; 2]; 3], at: [f32; 2]) -> f32 {
        let side = |p: [f32; 2], q: [f32; 2], r: [f32; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let turned = side(a, b, c).signum();
        [side(a, b, at), side(b, c, at), side(c, a, at)]
            .map(|s| s * turned)
            .into_iter()
            .fold(f32::MAX, f32::min)
    }

    #[test]
    fn rows_agree_with_asking_every_texel() {
        let mut point = points();
        for _ in 0..2000 {
            let triangle = [point(), point(), point()];
            let grid = covered(&[triangle]);
            for (i, &value) in grid.values.iter().enumerate() {
                let centre = [i % grid.width, i / grid.width].map(|i| i as f32 + 0.5);
                // Rounding may decide about centres on an edge.
                let depth = depth(triangle, centre);
                assert!(depth.abs() < 1e-3 || (value == 1.0) == (0.0 < depth), "{triangle:?} at {centre:?}");
            }
        }
    }

    #[test]
    fn triangles_that_share_an_edge_leave_no_gap() {
        let mut point = points();
        let corners = [[0.0, 0.0], [19.0, 0.0], [19.0, 14.0], [0.0, 14.0]];
        for _ in 0..500 {
            let hub = point().map(|c| c.clamp(0.5, 13.5) + 0.1);
            let fan: Vec<_> = (0..4).map(|i| [corners[i], corners[(i + 1) % 4], hub]).collect();
            assert!(covered(&fan).values.iter().all(|v| *v == 1.0), "{hub:?}");
        }
    }

    #[test]
    fn work_is_bounded_and_odd_numbers_do_no_harm() {
        let mut coverage = Coverage::new(SIDES[0], SIDES[1], 3 * SIDES[1]);
        let board = [[-1e9, -1e9], [1e9, -1e9], [0.0, 1e9]];
        let n_added = (0..10).filter(|_| coverage.add(board)).count();
        assert_eq!(n_added, 3);
        assert!(coverage.add([[0.0, 0.0], [5.0, 0.1], [0.0, 0.1]]), "one without a row is free");
        assert!(coverage.into_grid().values.iter().all(|v| *v == 1.0));
        for odd in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            covered(&[[[odd, 1.0], [3.0, odd], [5.0, 5.0]], [[odd; 2]; 3]]);
        }
    }

    #[test]
    fn a_blur_keeps_the_sum_and_the_middle() {
        let mut grid = Grid { width: 41, height: 33, values: vec![0.0; 41 * 33] };
        grid.values[16 * 41 + 20] = 1.0;
        let blurred = grid.blurred(3.0);
        let sum: f32 = blurred.values.iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        let most = blurred.values.iter().copied().fold(0.0, f32::max);
        assert_eq!(blurred.values[16 * 41 + 20], most);
        assert!((blurred.values[16 * 41 + 17] - blurred.values[13 * 41 + 20]).abs() < 1e-6, "round");
    }
}
