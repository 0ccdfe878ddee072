//! Polygons -> OBJ and MTL.

use crate::assembly::polygons::{PolygonMesh, doubled_area};
use crate::assembly::surface::Surface;
use crate::physics::numbers::{greater, lesser};
use nalgebra::Vector3;
use std::collections::BTreeMap;
use std::fmt::Write;

/// The materials that [`write()`] names: plain colours near the game's own textures.
pub const MATERIALS: &str = "\
# Materials of a maze: its walls, their tops, and its floor
newmtl wall
Ka 0 0 0
Kd 0.55 0.27 0.2
Ks 0 0 0
illum 1
newmtl top
Ka 0 0 0
Kd 0.68 0.62 0.55
Ks 0 0 0
illum 1
newmtl floor
Ka 0 0 0
Kd 0.72 0.53 0.33
Ks 0 0 0
illum 1
";

/// A face's group and normal.
struct Facing {
    surface: Surface,
    normal: Vector3<f64>,
}

/// A Wavefront OBJ with these polygons, +z up, in groups `wall`, `top` and `floor`, with normals and texture coordinates (in
/// units: walls run along x or y and z, the rest along x and y). Numbers are written in full, so reading it back gives the
/// same bits. `material_library` is the file name of [`MATERIALS`].
pub fn write(mesh: &PolygonMesh, material_library: &str, comment: &str) -> String {
    let mut text = String::new();
    // Writing to a String cannot fail.
    for line in comment.lines() {
        let _ = writeln!(text, "# {line}");
    }
    let _ = writeln!(text, "mtllib {material_library}");
    for p in mesh.positions() {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    // Floors and tops use the texture coordinate with the number of the position; walls have some of their own.
    for p in mesh.positions() {
        let _ = writeln!(text, "vt {} {}", p.x, p.y);
    }
    let middle_z = middle_height(mesh.positions());
    let mut of_walls = Numbered::new("vt", mesh.positions().len() + 1);
    let mut normals = Numbered::new("vn", 1);
    let mut faces = String::new();
    let mut group = None;
    for face in mesh.faces() {
        let corners: Vec<Vector3<f64>> =
            face.iter().map(|&corner| mesh.positions()[corner as usize]).collect();
        let Facing { surface, normal } = facing(&corners, middle_z);
        if group.replace(surface) != Some(surface) {
            let name = surface.name();
            let _ = writeln!(faces, "g {name}\nusemtl {name}");
        }
        let along = usize::from(normal.y.abs() < normal.x.abs());
        let normal = normals.number(normal.into(), &mut text);
        faces.push('f');
        for (corner, position) in face.iter().zip(&corners) {
            let texture = match surface {
                Surface::Wall => of_walls.number([position[along], position.z], &mut text),
                _ => *corner as usize + 1,
            };
            let _ = write!(faces, " {}/{texture}/{normal}", corner + 1);
        }
        faces.push('\n');
    }
    text + &faces
}

/// Halfway between the lowest and the highest position.
fn middle_height(positions: &[Vector3<f64>]) -> f64 {
    let heights = || positions.iter().map(|position| position.z);
    let low = heights().reduce(lesser);
    let high = heights().reduce(greater);
    (low.unwrap_or(0.0) + high.unwrap_or(0.0)) / 2.0
}

fn facing(corners: &[Vector3<f64>], middle_z: f64) -> Facing {
    let normal = doubled_area(corners).try_normalize(0.0).unwrap_or_else(Vector3::z);
    // Minus zero is written as such: adding zero takes the sign away.
    let normal = normal.map(|value| value + 0.0);
    let surface = match normal.z.abs() < 0.5 {
        true => Surface::Wall,
        false if corners.iter().all(|corner| middle_z < corner.z) => Surface::Top,
        false => Surface::Floor,
    };
    Facing { surface, normal }
}

/// Values with the numbers that OBJ gives them, each value once.
struct Numbered<const N: usize> {
    keyword: &'static str,
    first: usize,
    numbers: BTreeMap<[u64; N], usize>,
}

impl<const N: usize> Numbered<N> {
    fn new(keyword: &'static str, first: usize) -> Self {
        Self { keyword, first, numbers: BTreeMap::new() }
    }

    /// The number of a value; a new one is written.
    fn number(&mut self, value: [f64; N], text: &mut String) -> usize {
        let next = self.first + self.numbers.len();
        *self.numbers.entry(value.map(f64::to_bits)).or_insert_with(|| {
            text.push_str(self.keyword);
            for number in value {
                // Writing to a String cannot fail.
                let _ = write!(text, " {number}");
            }
            text.push('\n');
            next
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::{Layout, recursive_backtracker};
    use crate::{AssembleOptions, Maze, extrude, import};

    fn layout() -> Layout {
        recursive_backtracker(9, 7, 3).unwrap().with_doors_top_and_bottom()
    }

    #[test]
    fn a_generated_maze_written_and_read_back_is_the_same_maze() {
        for layout in [layout(), recursive_backtracker(9, 7, 3).unwrap()] {
            let mesh = extrude::extrude(&layout);
            let text = write(&mesh, "maze.mtl", "two\nlines");
            let back = import::obj::read(text.as_bytes()).unwrap();
            let [one, other] =
                [&mesh, &back].map(|mesh| Maze::from_polygons(mesh, &AssembleOptions::default()).unwrap());
            assert_eq!(one.planes, other.planes);
            assert_eq!(
                (one.start(), one.goal(), one.wall_height),
                (other.start(), other.goal(), other.wall_height)
            );
            assert_eq!(one.openings, other.openings);
            assert_eq!(one.surface.vertices.len(), other.surface.vertices.len());
        }
    }

    #[test]
    fn doors_are_openings_where_start_and_goal_are() {
        let maze = Maze::from_polygons(&extrude::extrude(&layout()), &AssembleOptions::default()).unwrap();
        assert_eq!(maze.openings.len(), 2);
        assert!(maze.is_solvable() && maze.report.scale == 1.0);
        // In at the top, out at the bottom, as on mazegenerator.net.
        let half = maze.bounds.high.y;
        assert!(
            half - 1.0 < maze.start().y && maze.goal().y < 1.0 - half,
            "{} {}",
            maze.start(),
            maze.goal()
        );
    }

    /// Numbers of the lines that begin with a word.
    fn numbers(text: &str, word: &str) -> Vec<Vec<f64>> {
        let rest = text.lines().filter_map(|line| line.strip_prefix(word)?.strip_prefix(' '));
        rest.map(|rest| rest.split(' ').map(|number| number.parse().unwrap()).collect()).collect()
    }

    #[test]
    fn every_corner_has_its_normal_and_texture_coordinate() {
        let text = write(&extrude::extrude(&layout()), "maze.mtl", "");
        let (v, vt, vn) = (numbers(&text, "v"), numbers(&text, "vt"), numbers(&text, "vn"));
        assert_eq!(vn.len(), 5, "up and four sides: {vn:?}");
        let mut group = "";
        let mut areas = BTreeMap::<&str, f64>::new();
        for line in text.lines() {
            group = line.strip_prefix("g ").unwrap_or(group);
            let Some(corners) = line.strip_prefix("f ") else { continue };
            let corners = corners.split(' ').map(|corner| {
                let mut index = corner.split('/').map(|index| index.parse::<usize>().unwrap() - 1);
                [index.next().unwrap(), index.next().unwrap(), index.next().unwrap()]
            });
            let corners: Vec<[usize; 3]> = corners.collect();
            let point = |corner: &[usize; 3]| Vector3::from_row_slice(&v[corner[0]]);
            let doubled = doubled_area(&corners.iter().map(point).collect::<Vec<_>>());
            for corner in &corners {
                let normal = Vector3::from_row_slice(&vn[corner[2]]);
                assert!((doubled.normalize() - normal).norm() < 1.0e-12, "{line}");
                let (p, uv) = (point(corner), &vt[corner[1]]);
                let expected = match (normal.x != 0.0, normal.y != 0.0) {
                    (true, _) => [p.y, p.z],
                    (_, true) => [p.x, p.z],
                    _ => [p.x, p.y],
                };
                assert_eq!(uv[..], expected, "{line}");
                let expected = if normal.z == 0.0 {
                    "wall"
                } else if p.z == 0.0 {
                    "floor"
                } else {
                    "top"
                };
                assert_eq!(group, expected);
            }
            *areas.entry(group).or_default() += doubled.norm() / 2.0;
        }
        let whole = (9.0 * 1.2 + 0.2) * (7.0 * 1.2 + 0.2);
        assert!((areas["floor"] - whole).abs() < 1.0e-9, "{areas:?}");
        let free = 9.0 * 7.0 + 0.2 * (9.0 * 7.0 - 1.0 + 2.0);
        assert!(
            (areas["top"] - (whole - free)).abs() < 1.0e-9,
            "cells, passages and doors are free: {areas:?}"
        );
        for material in ["wall", "top", "floor"] {
            assert!(MATERIALS.contains(&format!("newmtl {material}\n")) && areas.contains_key(material));
        }
    }
}
