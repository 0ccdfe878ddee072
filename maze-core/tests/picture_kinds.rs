//! F8, F10, F20: pictures as people make them: margins, tones, noise, cracks, colours, inversion and turned scans.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "a test may compute as it likes")]
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pixels are few")]

use maze_core::import::picture::{self, Picture, PictureError, WallTone};
use maze_core::layout::{Algorithm, Recipe};
use maze_core::{AssembleOptions, Blocks, Maze};
use proptest::prelude::*;

type Rgb = [u8; 3];
const WHITE: Rgb = [255; 3];
const BLACK: Rgb = [0; 3];

/// A picture to draw on.
#[derive(Clone)]
struct Paper {
    width: usize,
    height: usize,
    pixels: Vec<Rgb>,
}

impl Paper {
    fn new(width: usize, height: usize, ground: Rgb) -> Self {
        Self { width, height, pixels: vec![ground; width * height] }
    }

    /// Fills columns and rows from the first to before the second.
    fn fill(&mut self, x: [usize; 2], y: [usize; 2], ink: Rgb) {
        for y in y[0]..y[1] {
            self.pixels[y * self.width + x[0]..y * self.width + x[1]].fill(ink);
        }
    }

    fn read(&self) -> Result<Picture, PictureError> {
        picture::read(self.width, self.height, &self.pixels, None)
    }

    fn maze(&self) -> Maze {
        self.read().unwrap().maze(&AssembleOptions::default()).unwrap()
    }

    fn mapped(&self, tone: impl Fn(usize, Rgb) -> Rgb) -> Self {
        let pixels = self.pixels.iter().enumerate().map(|(index, pixel)| tone(index, *pixel));
        Self { pixels: pixels.collect(), ..*self }
    }

    /// Seen through a turn about its middle, corners cut off, onto white paper.
    fn turned(&self, degrees: f64) -> Self {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let side = self.width.max(self.height) * 3 / 2;
        let mut turned = Self::new(side, side, WHITE);
        for (index, pixel) in turned.pixels.iter_mut().enumerate() {
            let [x, y] = [index % side, index / side].map(|at| at as f64 - side as f64 / 2.0);
            let [u, v] = [x * cos + y * sin, y * cos - x * sin];
            let [u, v] = [u + self.width as f64 / 2.0, v + self.height as f64 / 2.0];
            if 0.0 <= u && 0.0 <= v && (u as usize) < self.width && (v as usize) < self.height {
                *pixel = self.pixels[v as usize * self.width + u as usize];
            }
        }
        turned
    }
}

/// A maze of walls and corridors of so many pixels, with openings at the top and the bottom.
fn drawn(seed: u64, [wall, corridor]: [usize; 2], margin: usize, [ink, ground]: [Rgb; 2]) -> Paper {
    let layout = Recipe::new(7, 5, Algorithm::Wilson, seed).layout().unwrap().with_doors_top_and_bottom();
    let blocks = Blocks::of_layout(&layout);
    let line = |k: usize| margin + k.div_ceil(2) * wall + k / 2 * corridor;
    let (n_x, n_y) = (blocks.width(), blocks.height());
    let mut paper = Paper::new(line(n_x) + margin, line(n_y) + margin, ground);
    for (x, y) in (0..n_y).flat_map(|y| (0..n_x).map(move |x| (x, y))) {
        if blocks.is_wall(x, n_y - 1 - y) {
            paper.fill([line(x), line(x + 1)], [line(y), line(y + 1)], ink);
        }
    }
    paper
}

fn is_same(one: &Maze, other: &Maze) -> bool {
    one.planes == other.planes && (one.start(), one.goal()) == (other.start(), other.goal())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    #[test]
    fn f20_margins_tones_and_inversion_change_nothing(
        seed in 0..1000_u64,
        wall in 2..6_usize,
        extra in 2..8_usize,
        margin in 0..20_usize,
    ) {
        let corridor = 2 * wall + extra;
        let plain = drawn(seed, [wall, corridor], 0, [BLACK, WHITE]).maze();
        for inks in [[BLACK, WHITE], [[90; 3], [200; 3]], [[20; 3], [100; 3]], [[150; 3], [250; 3]], [BLACK, [30, 60, 200]]] {
            let paper = drawn(seed, [wall, corridor], margin, inks);
            prop_assert!(is_same(&paper.maze(), &plain), "{inks:?}");
        }
        // Light walls on a dark ground, with a dark margin.
        let paper = drawn(seed, [wall, corridor], margin, [WHITE, BLACK]);
        let read = paper.read().unwrap();
        prop_assert_eq!(read.tone, WallTone::Light);
        prop_assert!(read.found().contains("light walls on a dark ground"));
        prop_assert!(is_same(&paper.maze(), &plain));
    }

    #[test]
    fn f8_f20_specks_cracks_and_smoothed_edges_open_and_close_nothing(seed in 0..1000_u64, spots in any::<u64>()) {
        let (wall, corridor) = (8, 20);
        let clean = drawn(seed, [wall, corridor], 10, [BLACK, WHITE]);
        let plain = clean.maze();
        // splitmix64: a plain product of the index would set the specks in lines, which are walls.
        let noise = |index: usize| {
            let mut z = spots.wrapping_add((index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15));
            z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            (z ^ (z >> 31)) >> 40
        };
        // A speck of one pixel in every 300, and noise of a compressed picture everywhere.
        let noisy = clean.mapped(|index, pixel| {
            let pixel = if noise(index) % 300 == 0 { pixel.map(|tone| 255 - tone) } else { pixel };
            pixel.map(|tone| if tone < 128 { tone + (noise(index) % 40) as u8 } else { tone - (noise(index) % 40) as u8 })
        });
        // Specks at edges may leave a dent of a pixel, which is met; where there is a wall nothing changes.
        let maze = noisy.maze();
        prop_assert!(maze.is_solvable());
        prop_assert_eq!(maze.openings.len(), plain.openings.len(), "{:?} {:?} {:?}", maze.openings, plain.openings, maze.bounds);
        prop_assert!((maze.path_length().unwrap() - plain.path_length().unwrap()).abs() < 1.0);
        // Cracks of one pixel through all walls.
        let mut cracked = clean.clone();
        let middle = cracked.width / 2;
        cracked.fill([middle, middle + 1], [0, clean.height], WHITE);
        prop_assert!(is_same(&cracked.maze(), &plain));
    }

    #[test]
    fn f20_turned_walls_are_refused_with_the_angle(seed in 0..1000_u64, degrees in prop_oneof![4..=45_i32, -44..=-4]) {
        let paper = drawn(seed, [5, 20], 10, [BLACK, WHITE]).turned(f64::from(degrees));
        match paper.read() {
            Err(PictureError::Turned { degrees: found }) => prop_assert!((found - degrees.abs()).abs() <= 1, "{found} {degrees}"),
            other => prop_assert!(false, "{degrees}: {other:?}"),
        }
    }

    #[test]
    fn f20_a_solution_in_colour_is_free_and_two_spots_are_start_and_goal(seed in 0..1000_u64, x in 0..7_usize, y in 0..4_usize) {
        let (wall, corridor) = (4, 16);
        let clean = drawn(seed, [wall, corridor], 6, [BLACK, WHITE]);
        let cell = |k: usize| 6 + wall + k * (wall + corridor) + corridor / 2;
        let mut lined = clean.clone();
        // A stroke as a painter would leave it, over walls too.
        lined.pixels.iter_mut().skip(clean.width * cell(1)).take(2 * clean.width).for_each(|pixel| {
            *pixel = if *pixel == WHITE { [220, 30, 40] } else { *pixel };
        });
        prop_assert!(is_same(&lined.maze(), &clean.maze()));
        let mut marked = clean.clone();
        marked.fill([cell(x) - 4, cell(x) + 4], [cell(y) - 4, cell(y) + 4], [30, 200, 60]);
        marked.fill([cell(6) - 3, cell(6) + 3], [cell(4) - 3, cell(4) + 3], [230, 30, 30]);
        let maze = marked.maze();
        prop_assert!(marked.read().unwrap().found().ends_with("start at the green spot, goal at the red spot"));
        let pitch = (wall + corridor) as f64 / corridor as f64;
        let (dx, dy) = (maze.goal().x - maze.start().x, maze.goal().y - maze.start().y);
        prop_assert!((dx - pitch * (6 - x) as f64).abs() < 0.2 && (dy + pitch * (4 - y) as f64).abs() < 0.2, "{dx} {dy}");
    }
}

#[test]
fn f8_a_notch_of_a_pixel_in_a_thick_outer_wall_is_no_opening() {
    let mut paper = Paper::new(62, 48, WHITE);
    paper.fill([4, 58], [4, 44], BLACK);
    paper.fill([10, 52], [10, 38], WHITE);
    paper.fill([10, 44], [18, 21], BLACK);
    paper.fill([18, 52], [28, 31], BLACK);
    let plain = paper.maze();
    assert!(plain.openings.is_empty());
    for [x, y] in [[[20, 40], [4, 5]], [[4, 5], [20, 30]], [[20, 40], [43, 44]], [[56, 58], [12, 16]]] {
        let mut notched = paper.clone();
        notched.fill(x, y, WHITE);
        let maze = notched.maze();
        assert!(maze.openings.is_empty(), "{x:?} {y:?}: {:?}", maze.openings);
        let moved = [maze.start() - plain.start(), maze.goal() - plain.goal()].map(|by| by.norm());
        assert!(moved.iter().all(|by| *by < 0.3), "{x:?} {y:?}: {moved:?}");
    }
}

#[test]
fn f20_what_can_be_either_is_refused_and_decided_by_the_flag() {
    // Walls and corridors of one width, the light ones around the dark ones.
    let paper = drawn(3, [6, 6], 0, [WHITE, BLACK]);
    match paper.read() {
        Err(error @ PictureError::Ambiguous) => assert!(error.to_string().contains("expected picture.wall")),
        other => panic!("{other:?}"),
    }
    let light = picture::read(paper.width, paper.height, &paper.pixels, Some(WallTone::Light)).unwrap();
    let dark = drawn(3, [6, 6], 0, [BLACK, WHITE]).read().unwrap();
    assert_eq!(light.blocks, dark.blocks);
}
