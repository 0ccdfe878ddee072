//! A small maze and plain textures, shared by the tests and the gallery.
#![allow(dead_code, reason = "each test program uses a part")]

use image::{Rgb, RgbImage};
use maze_core::surface::{Surface, SurfaceMesh, SurfaceVertex};
use maze_render::{BallView, Camera, Marker, Scene, TextureSet};
use nalgebra::{UnitQuaternion, Vector3};

pub(crate) const WALL_THICKNESS: f32 = 0.2;
pub(crate) const WALL_HEIGHT: f32 = 0.6;
pub(crate) const MAX_TILT_RAD: f32 = 0.26;

/// Cells and walls on a grid whose even lines are thin (walls and posts) and whose odd lines are corridors.
pub(crate) struct Board {
    solid: Vec<Vec<bool>>,
    pub(crate) n_cells: [usize; 2],
}

impl Board {
    /// A perfect maze, carved depth first by a small generator of its own: the same for the same seed.
    pub(crate) fn carved(n_x: usize, n_y: usize, seed: u64) -> Self {
        let mut solid = vec![vec![true; 2 * n_x + 1]; 2 * n_y + 1];
        let mut state = seed.wrapping_mul(2).wrapping_add(1);
        let mut random = move |n: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            usize::try_from(state >> 33).expect("31 bits") % n
        };
        solid[1][1] = false;
        let mut path = vec![(1_usize, 1_usize)];
        while let Some(&(x, y)) = path.last() {
            let mut next_cells = vec![];
            for (dx, dy) in [(2_isize, 0_isize), (-2, 0), (0, 2), (0, -2)] {
                let (Some(tx), Some(ty)) = (x.checked_add_signed(dx), y.checked_add_signed(dy)) else {
                    continue;
                };
                if tx < 2 * n_x + 1 && ty < 2 * n_y + 1 && solid[ty][tx] {
                    next_cells.push((tx, ty));
                }
            }
            if next_cells.is_empty() {
                path.pop();
            } else {
                let (tx, ty) = next_cells[random(next_cells.len())];
                solid[usize::midpoint(y, ty)][usize::midpoint(x, tx)] = false;
                solid[ty][tx] = false;
                path.push((tx, ty));
            }
        }
        Self { solid, n_cells: [n_x, n_y] }
    }

    /// Only the outer wall.
    pub(crate) fn empty(n_x: usize, n_y: usize) -> Self {
        let mut solid = vec![vec![false; 2 * n_x + 1]; 2 * n_y + 1];
        for (y, row) in solid.iter_mut().enumerate() {
            for (x, cell) in row.iter_mut().enumerate() {
                *cell = x == 0 || y == 0 || x == 2 * n_x || y == 2 * n_y;
            }
        }
        Self { solid, n_cells: [n_x, n_y] }
    }

    fn line(n_cells: usize, i: usize) -> f32 {
        let pitch = 1.0 + WALL_THICKNESS;
        let length = n_cells as f32 * pitch + WALL_THICKNESS;
        (i / 2) as f32 * pitch + (i % 2) as f32 * WALL_THICKNESS - 0.5 * length
    }

    pub(crate) fn half_size(&self) -> [f32; 3] {
        let [x, y] = self.n_cells.map(|n| Self::line(n, 2 * n + 2).min(0.5 * (n as f32 * 1.2 + 0.2)));
        [x, y, WALL_HEIGHT]
    }

    /// Centre of a cell, from the lower left.
    pub(crate) fn cell(&self, x: usize, y: usize) -> [f32; 2] {
        [(x, 0), (y, 1)].map(|(i, axis)| Self::line(self.n_cells[axis], 2 * i + 1) + 0.5)
    }

    pub(crate) fn mesh(&self) -> SurfaceMesh {
        let mut mesh = SurfaceMesh::default();
        let at = |x: usize, y: usize| [Self::line(self.n_cells[0], x), Self::line(self.n_cells[1], y)];
        let is_solid = |x: Option<usize>, y: Option<usize>| -> bool {
            x.zip(y).and_then(|(x, y)| self.solid.get(y)?.get(x).copied()).unwrap_or(false)
        };
        for (y, row) in self.solid.iter().enumerate() {
            for (x, &solid) in row.iter().enumerate() {
                let ([x0, y0], [x1, y1]) = (at(x, y), at(x + 1, y + 1));
                let h = if solid { WALL_HEIGHT } else { 0.0 };
                let surface = if solid { Surface::Top } else { Surface::Floor };
                quad(&mut mesh, surface, [[x0, y0, h], [x1, y0, h], [x1, y1, h], [x0, y1, h]]);
                if !solid {
                    continue;
                }
                let mut side = |open: bool, a: [f32; 2], b: [f32; 2]| {
                    if open {
                        let z = WALL_HEIGHT;
                        quad(
                            &mut mesh,
                            Surface::Wall,
                            [[a[0], a[1], 0.0], [b[0], b[1], 0.0], [b[0], b[1], z], [a[0], a[1], z]],
                        );
                    }
                };
                side(!is_solid(Some(x), y.checked_sub(1)), [x0, y0], [x1, y0]);
                side(!is_solid(Some(x + 1), Some(y)), [x1, y0], [x1, y1]);
                side(!is_solid(Some(x), Some(y + 1)), [x1, y1], [x0, y1]);
                side(!is_solid(x.checked_sub(1), Some(y)), [x0, y1], [x0, y0]);
            }
        }
        mesh
    }

    /// The scene without ball, start and goal.
    pub(crate) fn bare_scene(&self, aspect: f32) -> Scene {
        let mut scene = self.scene(aspect);
        scene.ball.radius = 0.0;
        scene.start.radius = 0.0;
        scene.goal.radius = 0.0;
        scene
    }

    /// The ball in the first cell, seen whole.
    pub(crate) fn scene(&self, aspect: f32) -> Scene {
        let [x, y] = self.cell(0, 0);
        Scene {
            camera: Camera::fitted(self.half_size(), aspect, MAX_TILT_RAD),
            world_from_maze: UnitQuaternion::identity(),
            ball: BallView { position: [x, y, 0.35], radius: 0.35, rotation: UnitQuaternion::identity() },
            ghost: None,
            start: Marker { position: [x, y], radius: 0.42 },
            goal: Marker { position: self.cell(self.n_cells[0] - 1, self.n_cells[1] - 1), radius: 0.45 },
            goal_glow: 0.5,
            lines: vec![],
            patches: vec![],
            shows_maze: true,
        }
    }
}

/// Corners counter-clockwise from outside.
fn quad(mesh: &mut SurfaceMesh, surface: Surface, corners: [[f32; 3]; 4]) {
    let [a, b, c, _] = corners.map(Vector3::from);
    let normal = (b - a).cross(&(c - a)).normalize();
    let first = u32::try_from(mesh.vertices.len()).expect("small");
    for p in corners {
        let uv = if normal.z.abs() > 0.5 {
            [p[0], p[1]]
        } else if normal.x.abs() > 0.5 {
            [p[1], p[2]]
        } else {
            [p[0], p[2]]
        };
        mesh.vertices.push(SurfaceVertex { position: p, normal: normal.into(), uv });
    }
    mesh.indices[surface as usize].extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
}

/// One colour each.
pub(crate) fn flat_textures(wall: [u8; 3], floor: [u8; 3], top: [u8; 3]) -> TextureSet {
    let flat = |colour| RgbImage::from_pixel(4, 4, Rgb(colour));
    TextureSet { wall: flat(wall), floor: flat(floor), top: flat(top) }
}
