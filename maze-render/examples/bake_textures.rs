//! Bakes the seamless textures in `assets/textures`: brick walls, a plank floor and stone wall tops.
//!
//! `cargo run -p maze-render --example bake_textures [OUT_DIR]`
//!
//! Every texture is a plain function of `(u, v)` in the unit square, `v` downwards, that repeats with period 1.
//! It gives a colour and a height; soft light from the height is then baked into the colour, for the
//! quality that draws without normal maps. The arithmetic is `+ - * /`, `sqrt` and `floor` only, all exactly specified by IEEE 754:
//! the files come out bit for bit the same.

use std::path::{Path, PathBuf};
use std::{env, fs};

use image::{ImageFormat, Rgb, RgbImage};

/// Width and height of each texture (texels). The floor covers 3 maze units, drawn at up to 170 pixels a unit:
/// still a texel for each pixel, and a file of 768 KiB.
const SIZE: u32 = 512;

fn main() -> Result<(), String> {
    let mut args = env::args_os().skip(1);
    let default_dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets/textures");
    let dir = args.next().map_or(default_dir, PathBuf::from);
    if args.next().is_some() || dir.as_os_str().as_encoded_bytes().starts_with(b"-") {
        return Err("usage: bake_textures [OUT_DIR]".to_owned());
    }
    fs::create_dir_all(&dir).map_err(|e| format!("cannot create {}: {e}", dir.display()))?;
    write(&bake(brick, BRICK_LIGHT), &dir.join("wall.bmp"))?;
    write(&bake(planks, PLANK_LIGHT), &dir.join("floor.bmp"))?;
    write(&bake(stone, STONE_LIGHT), &dir.join("top.bmp"))
}

/// Writes beside the target and renames, so that nobody ever reads half a picture.
fn write(picture: &RgbImage, path: &Path) -> Result<(), String> {
    let unfinished = path.with_extension("bmp.tmp");
    picture
        .save_with_format(&unfinished, ImageFormat::Bmp)
        .and_then(|()| Ok(fs::rename(&unfinished, path)?))
        .map_err(|e| {
            // Best effort: the failure worth reporting is the first one.
            let _ = fs::remove_file(&unfinished);
            format!("cannot write {}: {e}", path.display())
        })
}

// ---- Light ----------------------------------------------------------------------------------------------

/// What a texture says about one point: sRGB colour in 0..1 (mixed as encoded, as a painter would: the result
/// is judged by eye, not by radiometry) and height in texels.
struct Point {
    colour: Colour,
    height: f64,
}

/// How strongly the height field is baked into the colour.
#[derive(Clone, Copy)]
struct Light {
    /// Brightening for each texel of rise per texel to the right, and downwards: the lamp is up and to the left.
    slope: [f64; 2],
    /// Darkening for each texel that a point lies below its neighbourhood.
    cavity: f64,
}

/// Reach of the neighbourhood that shades a cavity (texels each way).
const CAVITY_REACH: u32 = 5;

fn bake(texture: fn(f64, f64) -> Point, light: Light) -> RgbImage {
    let centre = |i: u32| (f64::from(i) + 0.5) / f64::from(SIZE);
    let texels = || (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
    let points: Vec<Point> = texels().map(|(x, y)| texture(centre(x), centre(y))).collect();
    let index = |x: u32, y: u32| ((y % SIZE) * SIZE + x % SIZE) as usize;
    let height = |x: u32, y: u32| points[index(x, y)].height;

    // The mean over the square neighbourhood, rows first and then columns; `+ SIZE -` keeps the wrap unsigned.
    let reach = || (SIZE - CAVITY_REACH)..=(SIZE + CAVITY_REACH);
    let n_reach = f64::from(2 * CAVITY_REACH + 1);
    let row_mean = |(x, y)| reach().map(|d| height(x + d, y)).sum::<f64>() / n_reach;
    let rows: Vec<f64> = texels().map(row_mean).collect();
    let mean = |x: u32, y: u32| reach().map(|d| rows[index(x, y + d)]).sum::<f64>() / n_reach;

    RgbImage::from_fn(SIZE, SIZE, |x, y| {
        let rise_x = 0.5 * (height(x + 1, y) - height(x + SIZE - 1, y));
        let rise_y = 0.5 * (height(x, y + 1) - height(x, y + SIZE - 1));
        let facing = light.slope[0] * rise_x + light.slope[1] * rise_y;
        let hollow = light.cavity * (mean(x, y) - height(x, y)).max(0.0);
        // Both terms level off: a steep joint gets soft shade, never black or white.
        let shade = (1.0 + 0.35 * facing / (1.0 + facing.abs())) / (1.0 + hollow);
        Rgb(points[index(x, y)].colour.map(|c| byte(c * shade)))
    })
}

// ---- Textures -------------------------------------------------------------------------------------------

const BRICK_LIGHT: Light = Light { slope: [0.25, 0.5], cavity: 0.05 };

/// Running bond: eight courses of three bricks, every second course shifted by half a brick.
fn brick(u: f64, v: f64) -> Point {
    const N_COURSES: f64 = 8.0;
    const N_BRICKS: f64 = 3.0;
    /// Half the mortar joint, and the radius of a brick's corners (tile widths).
    const HALF_JOINT: f64 = 0.0075;
    const CORNER: f64 = 0.012;

    // Bricks are not ruled with a pen: wobble the plane a little before looking up the brick.
    let (u_wob, v_wob) = (u + 0.002 * fbm(u, v, [12, 12], 2, 1), v + 0.002 * fbm(u, v, [12, 12], 2, 2));
    let course = (v_wob * N_COURSES).floor().rem_euclid(N_COURSES);
    let along = u_wob * N_BRICKS + 0.5 * (course % 2.0);
    let id = hash(703, whole(along.floor().rem_euclid(N_BRICKS)), whole(course));
    let from_centre = [(fract(along) - 0.5) / N_BRICKS, (fract(v_wob * N_COURSES) - 0.5) / N_COURSES];
    let half = [0.5 / N_BRICKS - HALF_JOINT, 0.5 / N_COURSES - HALF_JOINT];
    let outside = box_distance(from_centre, half, CORNER) + 0.0022 * fbm(u, v, [48, 48], 3, 4);

    let rough = fbm(u, v, [40, 64], 4, 5);
    let blotch = fbm(u, v, [7, 10], 3, id);
    let grit = fbm(u, v, [150, 150], 2, 6);
    let pits = spots(u, v, 48, 0.20, 7);
    // Most bricks are red-brown to orange; the few that lay closest to the fire are dark.
    let fired = unit(id, 0, 1);
    let clay = mix(rgb(131, 76, 58), rgb(163, 99, 74), fired);
    let clay = if fired < 0.15 { rgb(123, 73, 58) } else { clay };
    let clay = mix(clay, rgb(196, 132, 100), 0.22 * smoothstep(0.0, 0.6, blotch));
    let clay = mix(clay, rgb(84, 48, 44), 0.30 * smoothstep(0.05, 0.6, -blotch) + 0.45 * pits);
    let clay = scale(clay, 1.0 + 0.10 * rough + 0.10 * grit);
    let mortar = mix(rgb(214, 199, 176), rgb(188, 171, 147), smoothstep(-0.4, 0.5, rough));
    let mortar = scale(mortar, 1.0 + 0.14 * grit);

    let body = smoothstep(0.002, -0.002, outside);
    let rounded = smoothstep(0.003, -0.010, outside);
    Point {
        colour: mix(mortar, clay, body),
        height: 5.0 * rounded + body * (0.9 * rough + unit(id, 0, 2) - 1.5 * pits) + 0.6 * grit,
    }
}

const PLANK_LIGHT: Light = Light { slope: [0.18, 0.3], cavity: 0.10 };

/// Planks along `u`, two lengths in each row, with the butt joints of neighbouring rows apart.
fn planks(u: f64, v: f64) -> Point {
    const N_ROWS: f64 = 8.0;
    /// Half the gap between planks, and the width of the eased edge (row widths).
    const HALF_GAP: f64 = 0.012;
    const BEVEL: f64 = 0.055;

    let row = (v * N_ROWS).floor();
    let y = fract(v * N_ROWS);
    // Steps of the golden ratio keep the joints of any few neighbouring rows well apart.
    let x_row = fract(u - 0.618_034 * row);
    let cut = 0.42 + 0.2 * unit(10, whole(row), 0);
    let (second, x, length) = if x_row < cut { (0, x_row, cut) } else { (1, x_row - cut, 1.0 - cut) };
    let id = hash(211, whole(row), second);
    let edge = y.min(1.0 - y).min(N_ROWS * x.min(length - x)) - HALF_GAP;

    // From here on lengths are in row widths. A knot pushes the grain aside; most planks have theirs out of sight.
    let long = x * N_ROWS;
    let centre_x = (0.2 + 0.6 * unit(id, 1, 0)) * length * N_ROWS;
    let centre_y = if unit(id, 1, 2) < 0.12 { 0.25 + 0.5 * unit(id, 1, 1) } else { 9.0 };
    let radius = 0.05 + 0.04 * unit(id, 1, 3);
    let (knot_x, knot_y) = ((long - centre_x) * 0.55, y - centre_y);
    let to_knot = (knot_x * knot_x + knot_y * knot_y).sqrt() + 0.02 * noise(x, y, [60, 8], 12);
    let push = radius * radius / (radius * radius + 0.6 * to_knot * to_knot);
    let y_grain = y - 0.85 * knot_y * push;

    // A plank is a flat cut through the tree's rings at a slight angle: the rings show as long arches,
    // and the slope outweighs the noise so that they do not close into islands.
    let heart = -0.4 + 1.8 * unit(id, 2, 0);
    let tilt = if unit(id, 2, 1) < 0.5 { -0.07 } else { 0.07 };
    let depth = 0.6 + 0.8 * unit(id, 2, 2) + tilt * long + 0.06 * fbm(x, y, [5, 1], 2, id);
    let off_heart = y_grain - heart + 0.07 * noise(x, y, [5, 1], id ^ 1);
    let rings = (10.0 + 5.0 * unit(id, 2, 3)) * (off_heart * off_heart + depth * depth).sqrt();
    let rings = rings + 0.16 * fbm(x, y, [12, 7], 2, id ^ 2);
    // Pale early wood darkens slowly towards the late wood, then the next year starts abruptly.
    let year = fract(rings);
    let late = year * year * smoothstep(1.0, 0.85, year) * (0.4 + 0.6 * unit(id, 3, whole(rings)));

    let fibre = fbm(x, y, [10, 22], 3, id ^ 3);
    let pores = smoothstep(0.25, 0.6, noise(x, y, [44, 30], id ^ 4));
    let wave = fbm(x, y, [6, 2], 2, id ^ 5);
    let wood = mix(rgb(176, 126, 76), rgb(216, 171, 116), unit(id, 4, 0));
    let wood = mix(wood, rgb(190, 128, 78), 0.5 * unit(id, 4, 1));
    let wood = mix(wood, rgb(132, 84, 46), 0.50 * late + 0.16 * pores);
    let wood = scale(wood, 1.0 + 0.07 * fibre + 0.06 * wave);
    let in_knot = smoothstep(1.2 * radius, 0.6 * radius, to_knot);
    let knot_ring = 0.5 + 0.5 * noise(to_knot, 0.5, [40, 1], id ^ 6);
    let wood = mix(wood, rgb(128, 82, 47), 0.6 * push * push * (1.0 - in_knot));
    let wood = mix(wood, mix(rgb(104, 64, 38), rgb(142, 92, 54), knot_ring), 0.7 * in_knot);

    let planed = smoothstep(-0.012, 0.012, edge);
    Point {
        colour: mix(rgb(82, 52, 31), wood, planed),
        height: 3.0 * smoothstep(-0.02, BEVEL, edge) - 0.25 * late + 0.2 * fibre - 0.2 * pores,
    }
}

const STONE_LIGHT: Light = Light { slope: [0.3, 0.4], cavity: 0.12 };

/// A sawn limestone slab without joints: clouded, grainy, with shell flecks, small pits and a few hair veins.
/// Nothing large stands out: one maze unit shows the whole tile, so a landmark would repeat all along a wall.
fn stone(u: f64, v: f64) -> Point {
    let bend = [fbm(u, v, [5, 5], 4, 20), fbm(u, v, [5, 5], 4, 21)];
    let [(u_soft, v_soft), (u_bent, v_bent)] = [0.01, 0.05].map(|k| (u + k * bend[0], v + k * bend[1]));
    let cloud = fbm(u_bent, v_bent, [5, 6], 3, 22);
    let warmth = fbm(u_bent, v_bent, [7, 8], 3, 23);
    // Plain octaves of fine noise look like orange peel: these counts share no factor and are equally strong.
    let even = |cells: [u32; 4]| cells.map(|n| noise(u_soft, v_soft, [n, n], n)).iter().sum::<f64>() / 2.0;
    let mottle = even([17, 26, 41, 63]);
    let grain = even([89, 131, 191, 256]);
    let pits = spots(u_soft, v_soft, 46, 0.22, 28) * smoothstep(-0.3, 0.3, mottle);
    let flecks = spots(u_soft, v_soft, 40, 0.4, 29);
    // A vein runs where smooth noise crosses zero; a second noise breaks it into lengths that fade out.
    let crossing = noise(u_bent, v_bent, [3, 3], 31).abs() + 0.012 * mottle.abs();
    let vein = smoothstep(0.022, 0.002, crossing) * smoothstep(-0.05, 0.4, noise(u, v, [5, 5], 32));

    let pale = smoothstep(-1.0, 1.0, 0.45 * cloud + 1.2 * mottle);
    let slab = mix(rgb(194, 186, 173), rgb(228, 220, 206), pale);
    let slab = mix(slab, rgb(208, 190, 164), 0.4 * smoothstep(-0.1, 0.6, warmth));
    let slab = mix(slab, rgb(236, 231, 221), 0.40 * flecks * (1.0 - vein) + 0.6 * vein);
    let slab = mix(slab, rgb(142, 131, 116), 0.55 * pits);
    Point {
        colour: scale(slab, 1.0 + 0.09 * grain),
        height: 0.4 * grain + 0.8 * mottle - 1.2 * pits - 0.3 * vein,
    }
}

// ---- Shapes and noise, all with period 1 in u and v ------------------------------------------------------

/// Sum of `n_octaves` of [`noise`], each twice as fine and half as strong; about -0.8..0.8.
fn fbm(u: f64, v: f64, cells: [u32; 2], n_octaves: u32, seed: u32) -> f64 {
    (0..n_octaves)
        .map(|i| noise(u, v, cells.map(|n| n << i), seed.wrapping_add(i << 16)) / f64::from(1_u32 << i))
        .sum()
}

/// Gradient noise (Perlin 1985, with the quintic fade of 2002) on `cells` lattice cells across the tile.
fn noise(u: f64, v: f64, cells: [u32; 2], seed: u32) -> f64 {
    let (x, y) = (u * f64::from(cells[0]), v * f64::from(cells[1]));
    let (fx, fy) = (fract(x), fract(y));
    let corner = |dx: f64, dy: f64| {
        let column = whole((x.floor() + dx).rem_euclid(f64::from(cells[0])));
        let line = whole((y.floor() + dy).rem_euclid(f64::from(cells[1])));
        let slope = hash(seed, column, line);
        (unit(slope, 0, 0) - 0.5) * (fx - dx) + (unit(slope, 0, 1) - 0.5) * (fy - dy)
    };
    let fade = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let lerp = |a: f64, b: f64, t: f64| a + (b - a) * t;
    let top = lerp(corner(0.0, 0.0), corner(1.0, 0.0), fade(fx));
    let bottom = lerp(corner(0.0, 1.0), corner(1.0, 1.0), fade(fx));
    2.6 * lerp(top, bottom, fade(fy))
}

/// Soft round spots of various sizes, 1 inside and 0 outside: one in a `share` of `n` x `n` cells.
fn spots(u: f64, v: f64, n: u32, share: f64, seed: u32) -> f64 {
    let (x, y) = (u * f64::from(n), v * f64::from(n));
    let mut strongest: f64 = 0.0;
    for (dx, dy) in (0..9).map(|i| (f64::from(i % 3 - 1), f64::from(i / 3 - 1))) {
        let (cell_x, cell_y) = (x.floor() + dx, y.floor() + dy);
        let wrap = |c: f64| whole(c.rem_euclid(f64::from(n)));
        let id = hash(seed, wrap(cell_x), wrap(cell_y));
        if unit(id, 0, 0) < share {
            let (from_x, from_y) = (x - cell_x - unit(id, 1, 0), y - cell_y - unit(id, 1, 1));
            let radius = 0.12 + 0.35 * unit(id, 2, 0) * unit(id, 2, 1);
            let distance = (from_x * from_x + from_y * from_y).sqrt();
            strongest = strongest.max(smoothstep(radius, 0.5 * radius, distance));
        }
    }
    strongest
}

/// Signed distance to a box of half extents `half` with rounded corners; negative inside.
fn box_distance(from_centre: [f64; 2], half: [f64; 2], corner: f64) -> f64 {
    let [x, y] = [0, 1].map(|i| from_centre[i].abs() - half[i] + corner);
    let (beyond_x, beyond_y) = (x.max(0.0), y.max(0.0));
    (beyond_x * beyond_x + beyond_y * beyond_y).sqrt() + x.max(y).min(0.0) - corner
}

/// 0 up to `from`, 1 beyond `to`, smooth between; `to < from` turns it round.
fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A number in 0..1 for a seed and two indices.
fn unit(seed: u32, x: u32, y: u32) -> f64 {
    f64::from(hash(seed, x, y)) / 4_294_967_296.0
}

/// Mixes the bits well enough that neighbouring cells look unrelated (the finaliser of MurmurHash3).
fn hash(seed: u32, x: u32, y: u32) -> u32 {
    [x, y].into_iter().fold(seed ^ 0x9e37_79b9, |h, k| {
        let h = (h ^ k).wrapping_mul(0x85eb_ca6b).wrapping_add(0x27d4_eb2f);
        let h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
        h ^ (h >> 16)
    })
}

fn fract(x: f64) -> f64 {
    x - x.floor()
}

// ---- Colours ---------------------------------------------------------------------------------------------

type Colour = [f64; 3];

fn rgb(r: u8, g: u8, b: u8) -> Colour {
    [r, g, b].map(|c| f64::from(c) / 255.0)
}

fn mix(a: Colour, b: Colour, t: f64) -> Colour {
    [0, 1, 2].map(|i| a[i] + (b[i] - a[i]) * t)
}

fn scale(colour: Colour, k: f64) -> Colour {
    colour.map(|c| c * k)
}

fn byte(channel: f64) -> u8 {
    whole(channel.clamp(0.0, 1.0) * 255.0 + 0.5).to_le_bytes()[0]
}

/// The whole part of a number that the caller keeps within 0..2^32.
#[expect(clippy::cast_possible_truncation, reason = "dropping the fraction is the purpose; `as` saturates")]
fn whole(x: f64) -> u32 {
    x as u32
}
