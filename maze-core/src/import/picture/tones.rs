//! Which pixels of a picture are wall: colours, the threshold between dark and light, inversion, specks and turned walls.

use super::{PictureError, WallTone};

/// A pixel darker than this is dark where both tones are there: half of the range, because drawn walls are near 0 and paper
/// is near 255, and smoothed edges and compression noise stay on their side.
const HALF: u8 = 128;

/// Fewer pixels than this fraction on one side of half are no tone of their own: the threshold is computed.
const FEW_FRACTION: f64 = 0.01;

/// Means of dark and light are at least so far apart, of 255.
const LEAST_CONTRAST: f64 = 32.0;

/// The largest of red, green and blue less the smallest from which on a pixel has a colour.
const COLOURED: u8 = 80;

/// Fraction of the pixels that may be marks and solutions in colour on a grey drawing.
const MAX_MARKED: f64 = 0.25;

/// How much wider than the light lines the dark ones are where the light ones are the walls.
const INVERTED_RATIO: usize = 3; // halves

/// Fraction of a border that is of one tone when nothing but noise and openings interrupts it.
const PURE_FRACTION: f64 = 0.98;
const CLOSED_FRACTION: f64 = 0.88;

/// A row or column of which at least one in so many pixels is of a tone is no opening.
const DENSE: usize = 4;

/// Steepest turn that is searched for, and the least that refuses a picture (degrees).
const MAX_TURN: i32 = 45;
const MIN_TURN: i32 = 3;

/// How much more the edges line up along a turned axis than along the picture's sides before the walls count as turned.
const TURNED_RATIO: f64 = 1.5;

/// About so many edge points say how the walls are turned.
const SAMPLED_EDGES: usize = 6000;

/// A rectangle of pixels, true for one of two kinds, row by row from the top.
#[derive(Clone, Debug)]
pub(super) struct Mask {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) pixels: Vec<bool>,
}

impl Mask {
    pub(super) fn at(&self, x: usize, y: usize) -> bool {
        self.pixels[y * self.width + x]
    }

    /// The first and the last column and row with such a pixel.
    pub(super) fn bounds(&self) -> Option<[usize; 4]> {
        let mut bounds: Option<[usize; 4]> = None;
        for (y, row) in self.pixels.chunks_exact(self.width).enumerate() {
            let (Some(first), Some(last)) = (row.iter().position(|p| *p), row.iter().rposition(|p| *p))
            else {
                continue;
            };
            let [left, right, top, _] = bounds.unwrap_or([first, last, y, y]);
            bounds = Some([left.min(first), right.max(last), top, y]);
        }
        bounds
    }

    /// The first and the last column and row of which a good fraction is such pixels: openings of a ring around them do not count.
    fn dense_bounds(&self) -> Option<[usize; 4]> {
        let is_dense = |n: usize, of: usize| of <= DENSE * n;
        let mut in_column = vec![0_usize; self.width];
        let mut rows = Vec::with_capacity(self.height);
        for row in self.pixels.chunks_exact(self.width) {
            rows.push(row.iter().filter(|pixel| **pixel).count());
            in_column.iter_mut().zip(row).for_each(|(n, pixel)| *n += usize::from(*pixel));
        }
        let first_and_last = |counts: &[usize], of: usize| {
            let first = counts.iter().position(|n| is_dense(*n, of))?;
            Some([first, counts.iter().rposition(|n| is_dense(*n, of))?])
        };
        let [left, right] = first_and_last(&in_column, self.height)?;
        let [top, bottom] = first_and_last(&rows, self.width)?;
        Some([left, right, top, bottom])
    }

    /// Calls with the start and length of each run of `value` in each row and each column, and whether it touches the border.
    fn each_run(&self, value: bool, mut see: impl FnMut(usize, [usize; 3], bool)) {
        for axis in [0, 1] {
            let [n, n_lines] = if axis == 0 { [self.width, self.height] } else { [self.height, self.width] };
            for line in 0..n_lines {
                let at = |k: usize| if axis == 0 { self.at(k, line) } else { self.at(line, k) };
                let mut k = 0;
                while k < n {
                    let first = k;
                    while k < n && at(k) == value {
                        k += 1;
                    }
                    if first < k {
                        see(axis, [line, first, k - first], first == 0 || k == n);
                    }
                    k += 1;
                }
            }
        }
    }

    /// The commonest length of runs of a value, the shortest on a tie; runs that touch the border say nothing. 0 without any.
    fn typical_run(&self, value: bool) -> usize {
        let mut counts = vec![0_u32; self.width.max(self.height) + 1];
        self.each_run(value, |_, [_, _, length], touches| counts[length] += u32::from(!touches));
        let most = counts.iter().copied().max().unwrap_or(0);
        if most == 0 { 0 } else { counts.iter().position(|n| *n == most).unwrap_or(0) }
    }

    /// Fraction of the border of a rectangle of pixels that has a value.
    fn border_part(&self, [left, right, top, bottom]: [usize; 4], value: bool) -> f64 {
        let across = (left..=right).flat_map(|x| [(x, top), (x, bottom)]);
        let along = (top..=bottom).flat_map(|y| [(left, y), (right, y)]);
        let (mut n, mut n_value) = (0_u32, 0_u32);
        for (x, y) in across.chain(along) {
            n += 1;
            n_value += u32::from(self.at(x, y) == value);
        }
        f64::from(n_value) / f64::from(n)
    }

    fn whole(&self) -> [usize; 4] {
        [0, self.width - 1, 0, self.height - 1]
    }
}

/// A picture's walls.
#[derive(Clone, Debug)]
pub(super) struct Tones {
    pub(super) wall: Mask,
    pub(super) tone: WallTone,
    /// Middles of a green and of a red spot, in pixels.
    pub(super) spots: [Option<[usize; 2]>; 2],
    /// Pixels in colour that count as free.
    pub(super) n_marked: usize,
}

/// Tells wall from free.
pub(super) fn read(
    width: usize,
    height: usize,
    rgb: &[[u8; 3]],
    wall: Option<WallTone>,
) -> Result<Tones, PictureError> {
    let is_coloured = |[r, g, b]: &[u8; 3]| COLOURED <= r.max(g).max(b) - r.min(g).min(b);
    let mut grey = [0_usize; 256]; // pixels by brightness, those without a colour
    let mut all = [0_usize; 256];
    for pixel in rgb {
        let brightness = usize::from(luma(*pixel));
        all[brightness] += 1;
        grey[brightness] += usize::from(!is_coloured(pixel));
    }
    let n_grey: usize = grey.iter().sum();
    let n_coloured = rgb.len() - n_grey;
    // Marks are in colour on a drawing that has both tones without them.
    let has_marks = 0 < n_coloured && to_f64(n_coloured) < MAX_MARKED * to_f64(rgb.len());
    let marked = has_marks.then(|| threshold(&grey)).flatten();
    let is_marked = |pixel: &[u8; 3]| marked.is_some() && is_coloured(pixel);
    let Some(threshold) = marked.or_else(|| threshold(&all)) else {
        let (index, darkest) =
            rgb.iter().map(|pixel| luma(*pixel)).enumerate().min_by_key(|(_, l)| *l).unwrap_or((0, HALF));
        if darkest < HALF {
            return Ok(Tones {
                wall: Mask { width, height, pixels: vec![true; rgb.len()] },
                tone: WallTone::Dark,
                spots: [None; 2],
                n_marked: 0,
            });
        }
        return Err(PictureError::NoWalls { x: index % width, y: index / width, darkest });
    };
    let pixels = rgb.iter().map(|pixel| luma(*pixel) < threshold && !is_marked(pixel)).collect();
    let mut dark = Mask { width, height, pixels };
    let tone = match wall {
        Some(tone) => tone,
        None => wall_tone(&dark)?,
    };
    if tone == WallTone::Light {
        for (is_dark, pixel) in dark.pixels.iter_mut().zip(rgb) {
            *is_dark = !*is_dark && !is_marked(pixel);
        }
    }
    let mut wall = dark;
    without_noise(&mut wall);
    expect_upright(&wall)?;
    let corridor = wall.typical_run(false);
    let spots = match marked {
        Some(_) => [1, 0].map(|channel| spot(width, rgb, channel, corridor)),
        None => [None; 2],
    };
    let n_marked = if marked.is_some() { n_coloured } else { 0 };
    Ok(Tones { wall, tone, spots, n_marked })
}

/// Rec. 601 luma.
pub(super) fn luma([r, g, b]: [u8; 3]) -> u8 {
    let sum = 299 * u32::from(r) + 587 * u32::from(g) + 114 * u32::from(b);
    u8::try_from(sum / 1000).unwrap_or(u8::MAX)
}

/// What is darker than this is dark: half where both sides of it are there, else where the two classes of brightness separate best
/// (Otsu 1979). `None` for one tone alone.
fn threshold(counts: &[usize; 256]) -> Option<u8> {
    let total: usize = counts.iter().sum();
    let below = |t: usize| counts[..t].iter().sum::<usize>();
    let few = FEW_FRACTION * to_f64(total);
    let n_dark = to_f64(below(usize::from(HALF)));
    if 0.0 < n_dark && few <= n_dark && n_dark <= to_f64(total) - few && n_dark < to_f64(total) {
        return Some(HALF);
    }
    let weighted = |range: std::ops::Range<usize>| range.map(|k| to_f64(k * counts[k])).sum::<f64>();
    let mut best: Option<(f64, usize)> = None;
    for t in 1..256 {
        let [dark, light] = [to_f64(below(t)), to_f64(total - below(t))];
        if dark == 0.0 || light == 0.0 {
            continue;
        }
        let between = weighted(t..256) / light - weighted(0..t) / dark;
        let variance = dark * light * between * between;
        if LEAST_CONTRAST <= between && best.is_none_or(|(known, _)| known < variance) {
            best = Some((variance, t));
        }
    }
    best.and_then(|(_, t)| u8::try_from(t).ok())
}

/// Dark walls, unless what is dark looks like corridors.
fn wall_tone(dark: &Mask) -> Result<WallTone, PictureError> {
    let [dark_run, light_run] = [true, false].map(|value| dark.typical_run(value));
    if dark_run == 0 || light_run == 0 {
        return Ok(WallTone::Dark);
    }
    let is_wide = INVERTED_RATIO * light_run <= 2 * dark_run;
    let light = Mask { pixels: dark.pixels.iter().map(|dark| !dark).collect(), ..*dark };
    let (Some(dark_box), Some(light_box)) = (dark.dense_bounds(), light.dense_bounds()) else {
        return Ok(WallTone::Dark);
    };
    if PURE_FRACTION <= dark.border_part(dark.whole(), true) {
        // A dark margin around light walls, or dark outer walls.
        let is_ring = light_box != dark.whole() && CLOSED_FRACTION <= dark.border_part(light_box, false);
        return Ok(if is_wide && is_ring { WallTone::Light } else { WallTone::Dark });
    }
    if dark.border_part(dark.whole(), false) < CLOSED_FRACTION {
        return Ok(WallTone::Dark);
    }
    // A light margin around dark walls, or light outer walls, which are as thick as the other ones.
    let [left, right, top, bottom] = dark_box;
    let margins = [left, dark.width - 1 - right, top, dark.height - 1 - bottom];
    let is_outer_wall =
        margins.iter().all(|margin| 3 * light_run <= 4 * margin && 3 * margin <= 4 * light_run);
    match (is_outer_wall, is_wide, dark.border_part(dark_box, true) < CLOSED_FRACTION) {
        (true, true, _) => Ok(WallTone::Light),
        (true, false, true) => Err(PictureError::Ambiguous),
        _ => Ok(WallTone::Dark),
    }
}

/// Turns specks over and fills cracks in walls, both far smaller than the walls are thick.
fn without_noise(wall: &mut Mask) {
    let [thick, wide] = [true, false].map(|value| wall.typical_run(value));
    let crack = thick.min(wide) / 4;
    if crack == 0 {
        return;
    }
    let most = (thick / 2) * (thick / 2);
    let mut seen = vec![false; wall.pixels.len()];
    let (mut region, mut open): (Vec<u32>, Vec<u32>) = (Vec::new(), Vec::new());
    for first in 0..seen.len() {
        if std::mem::replace(&mut seen[first], true) {
            continue;
        }
        let value = wall.pixels[first];
        region.clear();
        // A picture has far fewer pixels than 2^32.
        open.push(u32::try_from(first).unwrap_or(u32::MAX));
        while let Some(pixel) = open.pop() {
            if region.len() <= most {
                region.push(pixel);
            }
            let pixel = pixel as usize;
            let (x, y) = (pixel % wall.width, pixel / wall.width);
            let around = [
                (0 < x).then(|| pixel - 1),
                (x + 1 < wall.width).then(|| pixel + 1),
                (0 < y).then(|| pixel - wall.width),
                (y + 1 < wall.height).then(|| pixel + wall.width),
            ];
            for beside in around.into_iter().flatten() {
                if wall.pixels[beside] == value && !std::mem::replace(&mut seen[beside], true) {
                    open.extend(u32::try_from(beside));
                }
            }
        }
        if region.len() <= most {
            for pixel in &region {
                wall.pixels[*pixel as usize] = !value;
            }
        }
    }
    // Specks are gone: what is near a wall now is wall.
    let mut cracks = Vec::new();
    wall.each_run(false, |axis, [line, first, length], touches| {
        if !touches && length <= crack {
            let pixel = |k: usize| if axis == 0 { line * wall.width + k } else { k * wall.width + line };
            cracks.extend((first..first + length).map(pixel));
        }
    });
    for pixel in cracks {
        wall.pixels[pixel] = true;
    }
}

/// Refuses walls that are turned: their edges line up along a turned axis and not along the picture's sides.
fn expect_upright(wall: &Mask) -> Result<(), PictureError> {
    let is_edge = |x: usize, y: usize| {
        let here = wall.at(x, y);
        (x + 1 < wall.width && wall.at(x + 1, y) != here)
            || (y + 1 < wall.height && wall.at(x, y + 1) != here)
    };
    let all = || {
        let pixels = (0..wall.height).flat_map(|y| (0..wall.width).map(move |x| (x, y)));
        pixels.filter(|(x, y)| is_edge(*x, *y))
    };
    // Counted first: a picture may be nothing but edges.
    let step = all().count() / SAMPLED_EDGES + 1;
    let edges: Vec<[f64; 2]> = all().step_by(step).map(|(x, y)| [to_f64(x), to_f64(y)]).collect();
    let reach = wall.width + wall.height + 2;
    let mut counts = vec![0_u32; 2 * reach];
    let mut lines_up = |slope: f64| {
        let mut score = 0.0;
        for axis in [0, 1] {
            counts.fill(0);
            for [x, y] in &edges {
                let offset = if axis == 0 { y - slope * x } else { x + slope * y };
                // At most the sum of both sides away from 0.
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "0 to twice the reach"
                )]
                let bin = (offset + to_f64(reach)) as usize;
                if let Some(count) = counts.get_mut(bin) {
                    *count += 1;
                }
            }
            score += counts.iter().map(|count| f64::from(*count) * f64::from(*count)).sum::<f64>();
        }
        score
    };
    let upright = lines_up(0.0);
    let mut best = (upright, 0);
    let mut slope = 0.0;
    for degrees in 1..=MAX_TURN {
        // tan(a + 1 degree), by the addition theorem: the same bits everywhere.
        slope = (slope + TAN_1_DEGREE) / (1.0 - slope * TAN_1_DEGREE);
        for (slope, degrees) in [(slope, degrees), (-slope, -degrees)] {
            let score = lines_up(slope);
            if best.0 < score {
                best = (score, degrees);
            }
        }
    }
    let (score, degrees) = best;
    if MIN_TURN <= degrees.abs() && TURNED_RATIO * upright < score {
        return Err(PictureError::Turned { degrees: degrees.abs() });
    }
    Ok(())
}

/// Tangent of one degree.
const TAN_1_DEGREE: f64 = 0.017_455_064_928_217_585;

/// The middle of what has a colour, if it is one spot of about a corridor's width and not a line.
fn spot(width: usize, rgb: &[[u8; 3]], channel: usize, corridor: usize) -> Option<[usize; 2]> {
    let has_colour = |pixel: &[u8; 3]| {
        let others = (0..3).filter(|other| *other != channel).map(|other| pixel[other]);
        others.max().is_some_and(|other| COLOURED <= pixel[channel].saturating_sub(other))
    };
    let mut spot = Mask { width, height: rgb.len() / width, pixels: rgb.iter().map(has_colour).collect() };
    let [left, right, top, bottom] = spot.bounds()?;
    let [across, along] = [right + 1 - left, bottom + 1 - top];
    let most = 3 * corridor / 2 + 1;
    spot.pixels.clear();
    (across <= most && along <= most && 2 <= across.min(along))
        .then(|| [(left + right) / 2, (top + bottom) / 2])
}

#[allow(clippy::cast_precision_loss, reason = "a picture has far fewer than 2^53 pixels")]
fn to_f64(n: usize) -> f64 {
    n as f64
}
