//! Polygons -> OBJ bytes.

use crate::polygons::PolygonMesh;
use std::fmt::Write;

/// A Wavefront OBJ with these polygons, +z up. Numbers are written in full, so reading it back gives the same bits.
pub fn to_obj(mesh: &PolygonMesh, comment: &str) -> String {
    let mut text = String::new();
    for line in comment.lines() {
        text.push_str("# ");
        text.push_str(line);
        text.push('\n');
    }
    for p in mesh.positions() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for face in mesh.faces() {
        text.push('f');
        for corner in face {
            let _ = write!(text, " {}", corner + 1);
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use crate::{AssembleOptions, Maze, extrude, import, layout};

    #[test]
    fn a_generated_maze_written_and_read_back_is_the_same_maze() {
        let mesh = extrude::extrude(&layout::recursive_backtracker(9, 7, 3).unwrap());
        let text = super::to_obj(&mesh, "two\nlines");
        let back = import::obj::read(text.as_bytes()).unwrap();
        let [one, other] =
            [&mesh, &back].map(|mesh| Maze::from_polygons(mesh, &AssembleOptions::default()).unwrap());
        assert_eq!(one.planes, other.planes);
        assert_eq!((one.start, one.goal, one.wall_height), (other.start, other.goal, other.wall_height));
        assert_eq!(one.surface.vertices.len(), other.surface.vertices.len());
    }
}
