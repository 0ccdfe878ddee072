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

/// Two bytes a texel: the wide blur and the narrow one, 255 where all is wall.
pub(crate) struct OcclusionMap {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) texels: Vec<[u8; 2]>,
    /// Map coordinates from maze x and y: scale, then offset.
    pub(crate) uv_from_maze: [f32; 4],
}

impl OcclusionMap {
    /// Time and memory grow with the map's area, not with the number of walls.
    pub(crate) fn new(mesh: &SurfaceMesh, bounds: &Bounds) -> Self {
        let texels_per_unit = TEXELS_PER_UNIT.min(MAX_SIDE / (bounds.extent() + 2.0 * MARGIN));
        let origin = [bounds.min[0] - MARGIN, bounds.min[1] - MARGIN];
        let side = |axis: usize| {
            let units = bounds.max[axis] + MARGIN - origin[axis];
            to_index((units * texels_per_unit).ceil()).max(1)
        };
        let mut walls = Grid::empty(side(0), side(1));
        for triangle in mesh.indices_of(Surface::Top).as_chunks::<3>().0 {
            let corners = triangle.map(|i| {
                let [x, y, _] = mesh.vertices[i as usize].position;
                [(x - origin[0]) * texels_per_unit, (y - origin[1]) * texels_per_unit]
            });
            walls.fill(corners);
        }
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

struct Grid {
    width: usize,
    height: usize,
    values: Vec<f32>,
}

impl Grid {
    fn empty(width: usize, height: usize) -> Self {
        Self { width, height, values: vec![0.0; width * height] }
    }

    /// Marks the texels whose centre lies in a triangle (either way round), in texel coordinates.
    fn fill(&mut self, [a, b, c]: [[f32; 2]; 3]) {
        let span = |axis: usize, n: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]);
            let high = a[axis].max(b[axis]).max(c[axis]);
            to_index(low)..(to_index(high) + 1).min(n)
        };
        let side = |p: [f32; 2], q: [f32; 2], r: [f32; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        for y in span(1, self.height) {
            for x in span(0, self.width) {
                let centre = [x as f32 + 0.5, y as f32 + 0.5];
                let sides = [side(a, b, centre), side(b, c, centre), side(c, a, centre)];
                if sides.iter().all(|s| 0.0 <= *s) || sides.iter().all(|s| *s <= 0.0) {
                    self.values[y * self.width + x] = 1.0;
                }
            }
        }
    }

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

    #[test]
    fn a_blur_keeps_the_sum_and_the_middle() {
        let mut grid = Grid::empty(41, 33);
        grid.values[16 * 41 + 20] = 1.0;
        let blurred = grid.blurred(3.0);
        let sum: f32 = blurred.values.iter().sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum}");
        let most = blurred.values.iter().copied().fold(0.0, f32::max);
        assert_eq!(blurred.values[16 * 41 + 20], most);
        assert!((blurred.values[16 * 41 + 17] - blurred.values[13 * 41 + 20]).abs() < 1e-6, "round");
    }
}
