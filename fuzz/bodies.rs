//! What each fuzz target does with any bytes. `maze-core/tests/any_bytes.rs` does the same in `cargo test`.

use maze_core::import::picture::WallTone;
use maze_core::import::svg::SvgPlan;
use maze_core::import::text::TextOptions;
use maze_core::replay::Recording;
use maze_core::{AssembleOptions, Blocks, Layout, Maze, UpAxis, export, extrude, import, printable};

/// An OBJ file: polygons, and the maze they make.
pub(crate) fn obj(bytes: &[u8]) {
    if let Ok(mesh) = import::obj::read(bytes) {
        let _ = Maze::from_polygons(&mesh, &AssembleOptions::default());
    }
}

/// An SVG: written and read again it is the same maze, or the same in larger cells where no wall is one cell long or one
/// cell from the next.
pub(crate) fn svg(bytes: &[u8]) {
    if let Ok(plan) = import::svg::read(bytes) {
        assert!(!plan.found().contains('\n'));
        // Larger ones would leave no time to try many.
        let is_small = match &plan {
            SvgPlan::Cells(cells) => cells.layout.width() * cells.layout.height() < 1000,
            SvgPlan::Painted { blocks, .. } => blocks.width() * blocks.height() < 4000,
        };
        if is_small {
            let _ = plan.maze(&AssembleOptions::default());
        }
    }
    let Ok(maze) = import::svg::read_cells(bytes) else { return };
    let (width, height) = (maze.layout.width(), maze.layout.height());
    if maze.layout.n_passages() + width + height == 2 * width * height {
        // In a hall nothing shows how large cells are.
        return;
    }
    let text = export::svg::write(&maze.layout, maze.solution.as_deref(), "");
    let again = import::svg::read_cells(text.as_bytes());
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

/// A text maze: written and read again it is the same. Of the bytes the first says what is stated about signs.
pub(crate) fn text(bytes: &[u8]) {
    let (stated, bytes) = match bytes {
        [stated @ 0..8, bytes @ ..] => (*stated, bytes),
        _ => (0, bytes),
    };
    let said = |bit: u8, sign: &str| (stated & bit != 0).then(|| sign.to_owned());
    let options = TextOptions { wall: said(1, "#1"), free: said(2, ".0"), start: said(4, "A"), goal: None };
    let Ok(read) = import::text::read(bytes, &options) else { return };
    assert!(!read.found.contains('\n'), "{}", read.found);
    let blocks = &read.blocks;
    text_round_trip(blocks);
    if blocks.width() * blocks.height() < 4000 {
        let _ = read.maze(&AssembleOptions::default());
    }
}

fn text_round_trip(blocks: &Blocks) {
    let again = import::text::read(export::text::write(blocks).as_bytes(), &TextOptions::default());
    let again = again.expect("what was written can be read");
    // Walls in every second column only are read as separated by blanks, or as two characters a block; around an end beyond the
    // walls a wall is laid.
    let is_otherwise =
        ["two characters", "separated", "was laid"].iter().any(|words| again.found.contains(words));
    if is_otherwise {
        return;
    }
    let again = again.blocks;
    // What is free beyond all walls and ends is not written.
    let [left, bottom, top] = margins(blocks);
    assert_eq!(again.height() + bottom + top, blocks.height());
    for (x, y) in (0..blocks.height()).flat_map(|y| (0..blocks.width()).map(move |x| (x, y))) {
        let is_wall = left <= x && bottom <= y && again.is_wall(x - left, y - bottom);
        assert_eq!(is_wall, blocks.is_wall(x, y));
    }
    if matches!(blocks.ends(), [Some(start), Some(goal)] if start == goal) {
        // One sign is all that fits into a block.
        return;
    }
    let moved = blocks.ends().map(|end| end.map(|[x, y]| [x - left, y - bottom]));
    assert_eq!(again.ends(), moved);
}

/// Columns at the left, rows at the bottom and at the top with neither walls nor ends.
fn margins(blocks: &Blocks) -> [usize; 3] {
    let is_used = |x: usize, y: usize| blocks.is_wall(x, y) || blocks.ends().contains(&Some([x, y]));
    let (width, height) = (blocks.width(), blocks.height());
    let is_empty_row = |y: &usize| (0..width).all(|x| !is_used(x, *y));
    let left = (0..width).take_while(|x| (0..height).all(|y| !is_used(*x, y))).count();
    [left, (0..height).take_while(is_empty_row).count(), (0..height).rev().take_while(is_empty_row).count()]
}

/// A picture: two bytes for its size, the others are pixels, repeated as needed; most are grey, some have a colour.
pub(crate) fn picture(bytes: &[u8]) {
    let [width, height, pixels @ ..] = bytes else { return };
    let [width, height] = [*width, *height].map(usize::from);
    let colour = |byte: u8| match byte {
        3 => [220, 20, 30],
        5 => [20, 210, 40],
        grey => [grey; 3],
    };
    let pixels: Vec<[u8; 3]> = pixels.iter().copied().cycle().take(width * height).map(colour).collect();
    for wall in [None, Some(WallTone::Dark), Some(WallTone::Light)] {
        let Ok(picture) = import::picture::read(width, height, &pixels, wall) else { continue };
        let (n_x, n_y) = (picture.blocks.width(), picture.blocks.height());
        assert!(picture.left + n_x * picture.cell <= width && picture.top + n_y * picture.cell <= height);
        assert!(!picture.found().contains('\n'));
        if n_x * n_y < 4000 {
            let _ = picture.maze(&AssembleOptions::default());
        }
    }
}

/// A recording: written and read again it is the same, and nothing of it harms a terminal.
pub(crate) fn recording(bytes: &[u8]) {
    match Recording::from_bytes(bytes) {
        Ok(recording) => {
            assert_eq!(recording.to_bytes(), bytes);
            let shown = printable(&recording.source);
            assert!(!shown.chars().any(char::is_control) && shown.len() < 20_000);
        }
        Err(error) => assert!(!error.to_string().contains('\n')),
    }
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
    let back = import::svg::read_cells(svg.as_bytes()).expect("an SVG of ours");
    assert_eq!((&back.layout, &back.solution), (layout, &solution));
    text_round_trip(&Blocks::of_layout(layout));
}
