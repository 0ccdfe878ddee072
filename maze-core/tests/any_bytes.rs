//! The bodies of the fuzz targets on bytes of our own making: nothing panics, and what can be read can be written and read.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::disallowed_methods, reason = "a test may compute as it likes")]

#[path = "../../fuzz/bodies.rs"]
mod bodies;

use maze_core::layout::{Door, Side, recursive_backtracker};
use proptest::collection::vec;
use proptest::prelude::*;

/// Pieces of a format in any order: nearer to a file than any bytes are.
fn words(known: &'static [&'static str]) -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        8 => proptest::sample::select(known).prop_map(|word| word.as_bytes().to_vec()),
        2 => (-40_i32..40).prop_map(|number| number.to_string().into_bytes()),
        1 => vec(any::<u8>(), 0..3),
    ];
    vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

/// A good file with a few bytes changed, taken out or put in, or cut off.
fn damaged(good: String) -> impl Strategy<Value = Vec<u8>> {
    let n_bytes = good.len();
    let change = (0..n_bytes, prop_oneof![Just(None), any::<u8>().prop_map(Some)], any::<bool>());
    (vec(change, 1..5), n_bytes / 2..=n_bytes * 3).prop_map(move |(changes, end)| {
        let mut bytes = good.clone().into_bytes();
        for (at, byte, insert) in changes {
            match byte {
                Some(byte) if insert => bytes.insert(at.min(bytes.len()), byte),
                Some(byte) if at < bytes.len() => bytes[at] = byte,
                None if at < bytes.len() => drop(bytes.remove(at)),
                _ => {}
            }
        }
        bytes.truncate(end);
        bytes
    })
}

fn a_layout() -> impl Strategy<Value = maze_core::Layout> {
    let side = proptest::sample::select(vec![Side::Left, Side::Right, Side::Bottom, Side::Top]);
    let doors = vec((side, 0..12_usize), 0..4);
    (1..12_usize, 2..12_usize, any::<u64>(), doors).prop_map(|(width, height, seed, doors)| {
        let mut layout = recursive_backtracker(width, height, seed).unwrap();
        for (side, index) in doors {
            // A door beyond the wall's end is none.
            let _ = layout.open_door(Door { side, index });
        }
        layout
    })
}

const SVG: &[&str] = &[
    "<svg>",
    "</svg>",
    "<g>",
    "</g>",
    "<line ",
    "x1=\"",
    "y1=\"",
    "x2=\"",
    "y2=\"",
    "\" ",
    "/>",
    "<path d=\"M",
    "L",
    "H",
    "z",
    "<polyline points=\"",
    " ",
    ",",
    "\n",
    "<g transform=\"",
    "translate(",
    "scale(",
    ")",
    "<rect ",
    "width=\"",
    "style=\"",
    "stroke:none;",
    "NaN",
    "1e99",
    "<!DOCTYPE svg>",
    "<!--",
    "-->",
    "&lt;",
    "&#0;",
];

const OBJ: &[&str] = &[
    "v ", "f ", "vt ", "g ", "\n", "\r\n", " ", "/", "//", "1", "2", "3", "4", "-1", "0.5", "1e9", "nan", "#",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes(bytes in vec(any::<u8>(), 0..300)) {
        bodies::obj(&bytes);
        bodies::svg(&bytes);
        bodies::text(&bytes);
        bodies::picture(&bytes);
        bodies::recording(&bytes);
    }

    #[test]
    fn svg_of_words(bytes in words(SVG)) {
        bodies::svg(&bytes);
    }

    #[test]
    fn obj_of_words(bytes in words(OBJ)) {
        bodies::obj(&bytes);
    }

    #[test]
    fn text_of_words(bytes in words(&["#", "##", " ", "\n", "# #\n", "S", "G", "####", "\r\n"])) {
        bodies::text(&bytes);
    }

    #[test]
    fn pictures_of_few_tones(size in (1..40_u8, 1..40_u8), pixels in vec(prop_oneof![Just(0_u8), Just(255), any::<u8>()], 1..200)) {
        bodies::picture(&[vec![size.0, size.1], pixels].concat());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn every_layout_goes_through_all_formats_and_back(layout in a_layout()) {
        bodies::layout(&layout);
    }

    #[test]
    fn damaged_files(bytes in a_layout().prop_flat_map(|layout| {
        let mesh = maze_core::extrude::extrude(&layout);
        (
            damaged(maze_core::export::svg::write(&layout, layout.solution().as_deref(), "")),
            damaged(maze_core::export::obj::write(&mesh, "m", "")),
            damaged(maze_core::export::text::write(&maze_core::Blocks::of_layout(&layout))),
        )
    })) {
        bodies::svg(&bytes.0);
        bodies::obj(&bytes.1);
        bodies::text(&bytes.2);
    }
}
