//! Layouts -> SVG, in the form of mazegenerator.net.

use crate::assembly::extrude::runs;
use crate::layout::blocks::Blocks;
use crate::layout::{Layout, Side};
use std::fmt::Write;

/// Side of a cell, and margin around the outer wall, in the drawing's units.
const CELL: usize = 16;
const MARGIN: usize = 2;

/// Walls as maximal lines, all horizontal ones first. `solution` are cells (`y * width + x`), each beside the one before;
/// where it ends at a door, the line goes on through the door.
pub fn write(layout: &Layout, solution: Option<&[usize]>, comment: &str) -> String {
    let (width, height) = (layout.width(), layout.height());
    let [size_x, size_y] = [width, height].map(|n| n * CELL + 2 * MARGIN);
    let comment = escaped(comment);
    let mut text = format!(
        "<?xml version=\"1.0\" standalone=\"no\"?>\n\
         <!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n\
         <svg width=\"{size_x}\" height=\"{size_y}\" version=\"1.1\" xmlns=\"http://www.w3.org/2000/svg\">\n  \
         <title>{width} by {height} orthogonal maze</title>\n  <desc>{comment}</desc>\n  \
         <g fill=\"none\" stroke=\"#000000\" stroke-width=\"2\" stroke-linecap=\"square\">\n"
    );
    let mut line = |from: [usize; 2], to: [usize; 2]| {
        let [[x1, y1], [x2, y2]] = [from, to].map(|point| point.map(|at| MARGIN + CELL * at));
        // Writing to a String cannot fail.
        let _ = writeln!(text, "    <line x1=\"{x1}\" y1=\"{y1}\" x2=\"{x2}\" y2=\"{y2}\" />");
    };
    // Rows count from the top, as in the drawing.
    for row in 0..=height {
        runs(width, |x| is_wall_above(layout, x, row))
            .for_each(|[start, end]| line([start, row], [end, row]));
    }
    for x in 0..=width {
        runs(height, |row| is_wall_left(layout, x, row)).for_each(|[start, end]| line([x, start], [x, end]));
    }
    // A post at which no wall ends is a stroke without a length, which square caps make a dot.
    let blocks = Blocks::of_layout(layout);
    for (x, row) in (1..height).flat_map(|row| (1..width).map(move |x| (x, row))) {
        if blocks.is_lonely_post(2 * x, 2 * (height - row)) {
            line([x, row], [x, row]);
        }
    }
    text.push_str("  </g>\n");
    if let Some(points) = solution.and_then(|cells| solution_points(layout, cells)) {
        let points: Vec<String> = points.iter().map(|[x, y]| format!("{x},{y}")).collect();
        let _ = writeln!(
            text,
            "  <polyline fill=\"none\" stroke=\"#ff0000\" stroke-width=\"2\" stroke-linecap=\"square\" \
             stroke-linejoin=\"round\" points=\"{}\" />",
            points.join(" ")
        );
    }
    text.push_str("</svg>\n");
    text
}

fn is_wall_above(layout: &Layout, x: usize, row: usize) -> bool {
    let height = layout.height();
    match row {
        0 => !layout.has_door(Side::Top, x),
        _ if row == height => !layout.has_door(Side::Bottom, x),
        _ => !layout.is_open_north(x, height - 1 - row),
    }
}

fn is_wall_left(layout: &Layout, x: usize, row: usize) -> bool {
    let y = layout.height() - 1 - row;
    match x {
        0 => !layout.has_door(Side::Left, y),
        _ if x == layout.width() => !layout.has_door(Side::Right, y),
        _ => !layout.is_open_east(x - 1, y),
    }
}

/// The corners of a path through cells, from door to door; `None` without cells.
fn solution_points(layout: &Layout, cells: &[usize]) -> Option<Vec<[usize; 2]>> {
    let (width, height) = (layout.width(), layout.height());
    let middle = |cell: usize| {
        [cell % width, (height - 1).saturating_sub(cell / width)].map(|at| MARGIN + CELL * at + CELL / 2)
    };
    let door = |cell: usize| {
        let [x, y] = middle(cell);
        let at_door = |side: Side| match side {
            Side::Top => [x, y - CELL / 2],
            Side::Bottom => [x, y + CELL / 2],
            Side::Left => [x - CELL / 2, y],
            Side::Right => [x + CELL / 2, y],
        };
        let of_cell =
            |door: &crate::layout::Door| door.cell(width, height) == Some((cell % width, cell / width));
        layout.doors().find(of_cell).map(|door| at_door(door.side))
    };
    let (first, last) = (*cells.first()?, *cells.last()?);
    let all = door(first).into_iter().chain(cells.iter().map(|cell| middle(*cell)));
    let all = all.chain(door(last).filter(|_| first != last));
    let mut points: Vec<[usize; 2]> = Vec::new();
    for point in all {
        // In the middle of a straight stretch only its end moves on.
        if let [.., before, last] = points[..]
            && [0, 1].into_iter().any(|axis| before[axis] == last[axis] && last[axis] == point[axis])
        {
            points.pop();
        }
        points.push(point);
    }
    Some(points)
}

/// Text in XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
