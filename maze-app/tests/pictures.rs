//! `maze-app render`: the same picture each time, and the one we looked at.
//!
//! After an intended change: `UPDATE_GOLDENS=1 cargo test -p maze-app --test pictures`, then look at tests/golden/*.png.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use image::RgbImage;
use std::path::{Path, PathBuf};
use std::process::Command;

const DEFAULT_MAZE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../assets/mazes/default.obj");
const GOLDENS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden");

/// Two pictures are the same when few pixels differ by more than a rounding of colour: drivers of another version may
/// place an edge a subpixel elsewhere, and an edge pixel then changes by up to a wall's contrast.
const PIXEL_TOLERANCE: u8 = 12;
const MAX_DIFFERENT_FRACTION: f64 = 0.001;

/// Goldens are small: large enough to recognise a brick, small enough to keep.
const SIZE: &str = "480x270";

fn render(arguments: &[&str]) -> Vec<u8> {
    render_sized(SIZE, arguments)
}

fn render_sized(size: &str, arguments: &[&str]) -> Vec<u8> {
    let directory = tempfile::tempdir().unwrap();
    let out = directory.path().join("out.png");
    let output = Command::new(env!("CARGO_BIN_EXE_maze-app"))
        .args(["render", DEFAULT_MAZE, "--size", size, "--out"])
        .arg(&out)
        .args(arguments)
        .env("XDG_RUNTIME_DIR", directory.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    std::fs::read(out).unwrap()
}

fn decoded(png: &[u8]) -> RgbImage {
    image::load_from_memory(png).unwrap().into_rgb8()
}

/// Part of the pixels that differ, and a picture of where.
fn difference(a: &RgbImage, b: &RgbImage) -> (f64, RgbImage) {
    assert_eq!(a.dimensions(), b.dimensions());
    let mut where_different = RgbImage::new(a.width(), a.height());
    let mut n_different = 0_u32;
    for (x, y, pixel) in where_different.enumerate_pixels_mut() {
        let [a, b] = [a.get_pixel(x, y), b.get_pixel(x, y)];
        *pixel = image::Rgb([0, 1, 2].map(|channel| a[channel].abs_diff(b[channel])));
        n_different += u32::from(pixel.0.iter().any(|value| PIXEL_TOLERANCE < *value));
    }
    (f64::from(n_different) / f64::from(a.width() * a.height()), where_different)
}

fn expect_golden(name: &str, arguments: &[&str]) {
    expect_golden_sized(name, SIZE, arguments);
}

fn expect_golden_sized(name: &str, size: &str, arguments: &[&str]) {
    let png = render_sized(size, arguments);
    let path = Path::new(GOLDENS).join(format!("{name}.png"));
    if std::env::var_os("UPDATE_GOLDENS").is_some() {
        std::fs::write(&path, &png).unwrap();
    }
    let golden = decoded(&std::fs::read(&path).unwrap());
    let (part, where_different) = difference(&decoded(&png), &golden);
    if MAX_DIFFERENT_FRACTION < part {
        let target = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
        std::fs::write(target.join(format!("{name}.now.png")), &png).unwrap();
        where_different.save(target.join(format!("{name}.difference.png"))).unwrap();
        panic!("{:.2} % of {name} differs; see {}", 100.0 * part, target.display());
    }
}

#[test]
fn the_default_maze_looks_as_it_should_at_every_quality() {
    for quality in ["low", "medium", "high"] {
        expect_golden(quality, &["--quality", quality]);
    }
}

#[test]
fn a_tilted_maze_with_the_ball_on_its_way_looks_as_it_should() {
    expect_golden("tilted", &["--tilt", "12,-7", "--ticks", "25"]);
    expect_golden("tilted-low", &["--tilt", "12,-7", "--ticks", "25", "--quality", "low"]);
}

#[test]
fn zoomed_in_the_ball_and_what_is_around_it_look_as_they_should() {
    expect_golden("zoomed", &["--tilt", "3,-5", "--ticks", "40", "--zoom", "6"]);
    expect_golden("zoomed-low", &["--tilt", "3,-5", "--ticks", "40", "--zoom", "6", "--quality", "low"]);
}

/// Wide enough for a panel and something to see beside it.
const PANEL_SIZE: &str = "640x340";

#[test]
fn each_overlay_shows_what_it_should() {
    for (layer, arguments) in [
        ("gravity", "--tilt 9,-7 --ticks 60 --zoom 2"),
        ("planes", "--tilt -6,5"),
        ("search", "--tilt 9,-7 --ticks 14 --zoom 2"),
        ("contact", "--tilt 9,-7 --ticks 60 --zoom 6 --engine published"),
        ("velocity", "--tilt 9,-7 --ticks 60 --zoom 3"),
        ("clearance", "--tilt 9,-7 --ticks 60 --zoom 2"),
    ] {
        let mut words: Vec<&str> = arguments.split(' ').collect();
        words.extend(["--show", layer, "--quality", "low"]);
        expect_golden_sized(layer, PANEL_SIZE, &words);
    }
}

#[test]
fn planes_are_red_green_cyan_and_blue() {
    type IsColour = fn([i32; 3]) -> bool;
    let plain = decoded(&render(&["--quality", "low"]));
    let coloured = decoded(&render(&["--quality", "low", "--show", "planes"]));
    // The dominant channels of each facing's colour, counted where the plain picture has none of it.
    let count = |picture: &RgbImage, is_it: IsColour| {
        picture.pixels().filter(|pixel| is_it(pixel.0.map(i32::from))).count()
    };
    let colours: [(&str, IsColour); 4] = [
        ("red", |[r, g, b]| 170 < r && g < 110 && b < 100),
        ("green", |[r, g, b]| 150 < g && r + 50 < g && b + 50 < g),
        ("cyan", |[r, g, b]| 150 < g && 150 < b && r + 50 < g),
        ("blue", |[r, g, b]| 150 < b && r + 50 < b && g + 30 < b),
    ];
    for (name, is_it) in colours {
        let (before, after) = (count(&plain, is_it), count(&coloured, is_it));
        assert!(40 < after && 20 * before < after, "{name}: {before} pixels before, {after} after");
    }
}

#[test]
fn the_same_command_gives_the_same_bytes() {
    assert_eq!(render(&["--tilt", "5,5"]), render(&["--tilt", "5,5"]));
}

#[test]
fn the_tolerance_notices_a_degree_of_tilt_and_a_ball_that_has_moved() {
    let picture = decoded(&render(&[]));
    let (tilted, _) = difference(&picture, &decoded(&render(&["--tilt", "1,0"])));
    assert!(MAX_DIFFERENT_FRACTION < tilted, "{tilted}");
    let still = decoded(&render(&["--tilt", "12,-7", "--ticks", "25"]));
    let (moved, _) = difference(&still, &decoded(&render(&["--tilt", "12,-7", "--ticks", "28"])));
    assert!(MAX_DIFFERENT_FRACTION < moved, "{moved}");
    let (other_quality, _) = difference(&picture, &decoded(&render(&["--quality", "medium"])));
    assert!(MAX_DIFFERENT_FRACTION < other_quality, "{other_quality}");
}

#[test]
fn a_ghost_is_where_its_engine_has_its_ball() {
    let with = |arguments: &[&str]| {
        decoded(&render(&[&["--tilt", "9,-7", "--ticks", "30", "--zoom", "6"], arguments].concat()))
    };
    let [alone, same, other] = [&[][..], &["--ghost", "continuous"], &["--ghost", "published"]].map(with);
    let changed = |picture: &RgbImage, x: u32, y: u32| picture.get_pixel(x, y) != alone.get_pixel(x, y);
    // Zoomed in so far, the ball is in the middle.
    let [x, y] = [alone.width() / 2, alone.height() / 2];
    assert!(changed(&same, x, y) && !changed(&same, 5, 5) && !changed(&same, x, 5));
    let parts = [&same, &other].map(|picture| difference(&alone, picture).0);
    assert!(0.02 < parts[0] && parts[0] < 0.5, "as large as the ball: {parts:?}");
    assert!(MAX_DIFFERENT_FRACTION < difference(&same, &other).0, "the two engines differ");
}

#[test]
fn any_size_and_aspect_is_drawn() {
    for size in ["1x1", "31x700", "900x40"] {
        let picture = decoded(&render_sized(size, &[]));
        assert_eq!(format!("{}x{}", picture.width(), picture.height()), size);
    }
}

#[test]
fn frames_offscreen_are_logged_and_plotted() {
    let directory = tempfile::tempdir().unwrap();
    let [csv, plot] = ["frames.csv", "frames.png"].map(|name| directory.path().join(name));
    let output = Command::new(env!("CARGO_BIN_EXE_maze-app"))
        .args(["frames", "--offscreen", "--seconds", "1", "--size", "160x90", "--quality", "low", "--csv"])
        .arg(&csv)
        .arg("--plot")
        .arg(&plot)
        .env("XDG_RUNTIME_DIR", directory.path())
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success() && text.contains("160x90, quality low"), "{text}");
    for line in ["frame time", "our thread", "all threads", "graphics adapter", "start to first frame"] {
        assert!(text.contains(line), "{text}");
    }
    let refused = Command::new(env!("CARGO_BIN_EXE_maze-app"))
        .args(["frames", "--offscreen", "--csv"])
        .arg(&plot)
        .arg("--plot")
        .arg(&plot)
        .output()
        .unwrap();
    assert_eq!(refused.status.code(), Some(2), "one name for two files");
    let csv = std::fs::read_to_string(csv).unwrap();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert!(5 < rows.len() && rows.iter().all(|row| row.len() == 8), "{csv}");
    assert!(rows[1..].iter().any(|row| row[7].parse::<f64>().is_ok_and(|ms| 0.0 < ms)), "the adapter's time");
    assert_eq!(image::image_dimensions(plot).unwrap(), (960, 640));
}
