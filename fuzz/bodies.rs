//! What each fuzz target does with any bytes. `maze-core/tests/any_bytes.rs` does the same in `cargo test`.

use maze_core::{AssembleOptions, Blocks, Layout, Maze, UpAxis, export, extrude, import};

/// An OBJ file: polygons, and the maze they make.
pub(crate) fn obj(bytes: &[u8]) {
    if let Ok(mesh) = import::obj::read(bytes) {
        let _ = Maze::from_polygons(&mesh, &AssembleOptions::default());
    }
}

/// An SVG: written and read again it is the same maze, or the same in larger cells where no wall is one cell long or one
/// cell from the next.
pub(crate) fn svg(bytes: &[u8]) {
    let Ok(maze) = import::svg::read(bytes) else { return };
    let text = export::svg::write(&maze.layout, maze.solution.as_deref(), "");
    let again = import::svg::read(text.as_bytes());
    let again = again.unwrap_or_else(|error| panic!("{error}: {text}"));
    let [one, other] = [&maze.layout, &again.layout].map(|layout| [layout.width(), layout.height()]);
    if one == other {
        assert_eq!(again.layout, maze.layout);
        assert_eq!(again.solution, maze.solution);
    } else {
        assert!([0, 1].into_iter().all(|axis| one[axis] % other[axis] == 0), "{one:?} {other:?}");
    }
    // Larger ones would leave no time to try many.
    if maze.layout.width() * maze.layout.height() < 1000 {
        let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() };
        Maze::from_polygons(&extrude::extrude(&maze.layout), &options).expect("every layout is a maze");
        text_round_trip(&Blocks::of_layout(&maze.layout));
    }
}

/// A text maze: written and read again it is the same.
pub(crate) fn text(bytes: &[u8]) {
    let Ok(blocks) = import::text::read(bytes) else { return };
    text_round_trip(&blocks);
    if blocks.width() * blocks.height() < 4000 {
        let _ = blocks.maze(&AssembleOptions::default());
    }
}

fn text_round_trip(blocks: &Blocks) {
    let again =
        import::text::read(export::text::write(blocks).as_bytes()).expect("what was written can be read");
    // Free places at the right of all lines are not written.
    assert_eq!(again.height(), blocks.height());
    for (x, y) in (0..blocks.height()).flat_map(|y| (0..blocks.width()).map(move |x| (x, y))) {
        assert_eq!(again.is_wall(x, y), blocks.is_wall(x, y));
    }
    assert_eq!(again.ends(), blocks.ends());
}

/// A picture: two bytes for its size, the others are pixels, repeated as needed.
pub(crate) fn picture(bytes: &[u8]) {
    let [width, height, pixels @ ..] = bytes else { return };
    let [width, height] = [*width, *height].map(usize::from);
    let pixels: Vec<u8> = pixels.iter().copied().cycle().take(width * height).collect();
    let Ok(picture) = import::picture::read(width, height, &pixels) else { return };
    assert_eq!(picture.blocks.width() * picture.cell + picture.left + right_margin(width, &pixels), width);
    if picture.blocks.width() * picture.blocks.height() < 4000 {
        let _ = picture.maze(&AssembleOptions::default());
    }
}

/// Columns without a dark pixel at the right.
fn right_margin(width: usize, pixels: &[u8]) -> usize {
    (0..width).rev().take_while(|x| pixels.chunks(width).all(|row| 128 <= row[*x])).count()
}

/// Any layout: through OBJ, SVG and text and back.
pub(crate) fn layout(layout: &Layout) {
    let mesh = extrude::extrude(layout);
    let back = import::obj::read(export::obj::write(&mesh, "m.mtl", "").as_bytes()).expect("an OBJ of ours");
    let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..Default::default() };
    let [one, other] =
        [&mesh, &back].map(|mesh| Maze::from_polygons(mesh, &options).expect("a layout is a maze"));
    assert_eq!(one.planes, other.planes);
    let solution = layout.solution();
    let svg = export::svg::write(layout, solution.as_deref(), "");
    let back = import::svg::read(svg.as_bytes()).expect("an SVG of ours");
    assert_eq!((&back.layout, &back.solution), (layout, &solution));
    text_round_trip(&Blocks::of_layout(layout));
}
