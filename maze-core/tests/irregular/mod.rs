//! Scenes as nobody builds them on purpose, made from a seed: every wall has coordinates of its own.
//!
//! A scene is a closed room with some gadgets in it: boxes and walls without thickness anywhere, gaps as wide as the ball give or
//! take an ulp, nooks, staircases of steps down to 1e-9, floors with slits, faces an ulp apart. Balls, restitutions, tick
//! lengths, accelerations and where the room lies come from the seed too.

#![allow(dead_code, reason = "each test uses a part of it")]

use super::noise::Noise;
use maze_core::{Ball, BallSpec, Facing, Plane, Radius};
use nalgebra::Vector2;

/// Half of the room's width and height (units).
pub(crate) const HALF: f64 = 4.0;

/// How the acceleration changes from tick to tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Acceleration {
    /// Another one in every tick.
    Random,
    /// The same for so many ticks, then its opposite.
    Flips(u32),
    /// A little further around in each tick.
    Turns,
    /// Along one of the axes, another one after so many ticks.
    Axes(u32),
    /// Another one after so many ticks.
    Steady(u32),
    /// None.
    None,
}

/// A room, a ball, and what moves it.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) planes: Vec<Plane>,
    pub(crate) middle: Vector2<f64>,
    pub(crate) spec: BallSpec,
    pub(crate) ball: Ball,
    pub(crate) tick_s: f64,
    pub(crate) acceleration: Acceleration,
    /// Of the acceleration (units/s²).
    pub(crate) strength: f64,
}

/// Draws from a seed.
struct Draw(Noise);

impl Draw {
    /// 0 to 1.
    fn fraction(&mut self) -> f64 {
        self.0.next() / 2.0 + 0.5
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.fraction()
    }

    /// 10 to a power between two.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        10.0_f64.powf(self.between(low, high))
    }

    fn chance(&mut self, one_in: f64) -> bool {
        self.fraction() * one_in < 1.0
    }

    fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 <= index, small")]
        let index = (self.fraction() * from.len() as f64) as usize;
        from[index.min(from.len() - 1)]
    }
}

/// A solid rectangle.
pub(crate) fn block([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> Vec<Plane> {
    let face = |facing, offset, start, end| Plane { facing, offset, start, end };
    let faces = [
        face(Facing::MinusX, x0, y0, y1),
        face(Facing::PlusX, x1, y0, y1),
        face(Facing::MinusY, y0, x0, x1),
        face(Facing::PlusY, y1, x0, x1),
    ];
    faces.into_iter().filter(|face| face.start < face.end).collect()
}

/// A wall without thickness across an axis: both of its sides.
fn sheet(axis: usize, offset: f64, [start, end]: [f64; 2]) -> Vec<Plane> {
    let sides = if axis == 0 { [Facing::PlusX, Facing::MinusX] } else { [Facing::PlusY, Facing::MinusY] };
    if start < end { sides.map(|facing| Plane { facing, offset, start, end }).into() } else { Vec::new() }
}

/// The parts of a room, in the order in which they are drawn.
struct Builder {
    draw: Draw,
    planes: Vec<Plane>,
    middle: Vector2<f64>,
    radius: f64,
}

impl Builder {
    /// Somewhere in the room.
    fn place(&mut self) -> Vector2<f64> {
        let x = self.draw.between(-HALF, HALF);
        self.middle + Vector2::new(x, self.draw.between(-HALF, HALF))
    }

    fn add_block(&mut self, x: [f64; 2], y: [f64; 2]) {
        let inside = |limits: [f64; 2], middle: f64| limits.map(|v| v.clamp(middle - HALF, middle + HALF));
        let (x, y) = (inside(x, self.middle.x), inside(y, self.middle.y));
        if x[0] < x[1] && y[0] < y[1] {
            self.planes.extend(block(x, y));
        }
    }

    /// A box with a length and a thickness of its own.
    fn any_box(&mut self) {
        let low = self.place();
        let (length, thickness) = (self.draw.decades(-1.0, 0.5), self.draw.decades(-6.0, 0.0));
        let size = if self.draw.chance(2.0) { [length, thickness] } else { [thickness, length] };
        self.add_block([low.x, low.x + size[0]], [low.y, low.y + size[1]]);
    }

    /// Walls without thickness: one, an L, a T or a cross.
    fn sheets(&mut self) {
        let at = self.place();
        let mut reach = || if self.draw.chance(2.0) { 0.0 } else { self.draw.decades(-1.0, 0.3) };
        let (left, right, down, up) = (reach(), reach(), reach(), reach());
        self.planes.extend(sheet(1, at.y, [at.x - left, at.x + right]));
        self.planes.extend(sheet(0, at.x, [at.y - down, at.y + up]));
    }

    /// How far a gap differs from the ball's diameter.
    fn misfit(&mut self) -> f64 {
        let size =
            self.draw.pick(&[0.0, 1.0e-16, 1.0e-14, 1.0e-12, 1.0e-10, 1.0e-9, 1.0e-6, 1.0e-3, 0.1, 0.6]);
        let size = size * self.radius;
        if self.draw.chance(2.0) { size } else { -size }
    }

    /// Two boxes with a gap about as wide as the ball, side by side or one set back.
    fn gap(&mut self) {
        let (at, gap) = (self.place(), 2.0 * self.radius + self.misfit());
        let (length, back) = (self.draw.decades(-0.5, 0.3), self.draw.between(-0.5, 0.5));
        let thickness = self.draw.decades(-3.0, 0.0);
        if self.draw.chance(2.0) {
            self.add_block([at.x, at.x + length], [at.y - thickness, at.y]);
            self.add_block([at.x + back, at.x + back + length], [at.y + gap, at.y + gap + thickness]);
        } else {
            self.add_block([at.x - thickness, at.x], [at.y, at.y + length]);
            self.add_block([at.x + gap, at.x + gap + thickness], [at.y + back, at.y + back + length]);
        }
    }

    /// A slot that is open on one side, about as wide as the ball.
    fn nook(&mut self) {
        let (at, width) = (self.place(), 2.0 * self.radius + self.misfit());
        let (depth, side) = (self.radius * self.draw.between(0.1, 3.0), self.draw.decades(-3.0, -0.3));
        let back = self.draw.decades(-3.0, -0.3);
        self.add_block([at.x - side, at.x], [at.y - back, at.y + depth]);
        self.add_block([at.x + width, at.x + width + side], [at.y - back, at.y + depth]);
        self.add_block([at.x - side, at.x + width + side], [at.y - back, at.y]);
    }

    /// Boxes side by side whose tops differ by steps of one size, up and down.
    fn staircase(&mut self) {
        let at = self.place();
        let step = self.draw.pick(&[1.0e-16, 1.0e-13, 1.0e-12, 1.0e-11, 1.0e-9, 1.0e-6, 1.0e-3, 0.05, 0.3]);
        let width = self.radius * self.draw.decades(-4.0, 1.0);
        let depth = self.draw.decades(-2.0, 0.0);
        let turned = self.draw.chance(2.0);
        let (mut along, mut top) = (if turned { at.y } else { at.x }, if turned { at.x } else { at.y });
        let bottom = top - depth;
        for _ in 0..8 {
            let next = along + width * self.draw.between(0.2, 1.0);
            match turned {
                true => self.add_block([bottom, top], [along, next]),
                false => self.add_block([along, next], [bottom, top]),
            }
            top += if self.draw.chance(2.0) { step } else { -step };
            along = next;
        }
    }

    /// A floor of boxes with slits between them.
    fn slits(&mut self) {
        let at = self.place();
        let depth = self.draw.decades(-2.0, 0.0);
        let mut along = at.x;
        for _ in 0..5 {
            let next = along + self.radius * self.draw.decades(-1.0, 0.7);
            self.add_block([along, next], [at.y - depth, at.y]);
            along = next + self.draw.decades(-16.0, -1.0).max(next.abs() * f64::EPSILON);
        }
    }

    /// A wall whose two halves, or whose copy, lie an ulp or two apart.
    fn twins(&mut self) {
        let at = self.place();
        let (length, thickness) = (self.draw.decades(-1.0, 0.3), self.draw.decades(-4.0, 0.0));
        let mut other = at;
        for _ in 0..2 {
            other = if self.draw.chance(2.0) {
                Vector2::new(other.x.next_up(), other.y)
            } else {
                Vector2::new(other.x, other.y.next_down())
            };
        }
        let begin = if self.draw.chance(2.0) { other.x } else { other.x + length };
        self.add_block([at.x, at.x + length], [at.y - thickness, at.y]);
        self.add_block([begin, begin + length], [other.y - thickness, other.y]);
    }

    fn gadget(&mut self) {
        match self.draw.pick(&[0, 1, 2, 3, 4, 5, 6, 7]) {
            0 | 1 => self.any_box(),
            2 => self.sheets(),
            3 => self.gap(),
            4 => self.nook(),
            5 => self.staircase(),
            6 => self.slits(),
            _ => self.twins(),
        }
    }
}

/// What rounding may add to a depth: four to eight ulps of the ball's largest coordinate, which count far from the origin (at
/// 10⁵ units 9e-11 units).
pub(crate) fn rounding(position: Vector2<f64>) -> f64 {
    4.0 * f64::EPSILON * position.amax()
}

/// How deep a circle is in the faces, by a plain look at each; negative where it is clear of them.
pub(crate) fn depth(planes: &[Plane], centre: Vector2<f64>, radius: f64) -> f64 {
    let mut nearest = f64::INFINITY;
    for plane in planes {
        let axis = plane.facing.axis();
        let along = centre[1 - axis].clamp(plane.start, plane.end) - centre[1 - axis];
        let across = centre[axis] - plane.offset;
        nearest = nearest.min(across * across + along * along);
    }
    radius - nearest.sqrt()
}

/// Whether a point lies in no wall: a ray towards +x leaves as many boxes as it enters, and then meets the room's side.
fn is_free(planes: &[Plane], centre: Vector2<f64>) -> bool {
    let is_crossed = |plane: &&Plane| {
        plane.facing.axis() == 0 && centre.x < plane.offset && plane.start <= centre.y && centre.y < plane.end
    };
    let (n_left, n_entered): (Vec<&Plane>, Vec<&Plane>) =
        planes.iter().filter(is_crossed).partition(|plane| plane.facing == Facing::PlusX);
    n_left.len() + 1 == n_entered.len()
}

impl Scene {
    /// The scene of a seed. `None` for the few seeds whose gadgets leave the ball no room.
    pub(crate) fn new(seed: u64) -> Option<Self> {
        // Neighbouring seeds of the generator share their numbers, one apart.
        let mut draw = Draw(Noise(seed.wrapping_mul(0x2545_f491_4f6c_dd1d)));
        let radius = match draw.pick(&[0, 1, 2]) {
            0 => draw.decades(-3.0, -0.302),
            1 => draw.between(0.1, 0.499),
            _ => 0.35,
        };
        let far = draw.pick(&[0.0, 0.0, 0.0, 10.0, 1.0e3, 1.0e5]);
        let middle = Vector2::new(draw.0.next(), draw.0.next()) * far;
        let mut builder = Builder { draw, planes: Vec::new(), middle, radius };
        let n_gadgets = builder.draw.pick(&[1, 2, 4, 8, 14]);
        for _ in 0..n_gadgets {
            builder.gadget();
        }
        let (low, high) = (middle - Vector2::repeat(HALF), middle + Vector2::repeat(HALF));
        builder.planes.extend([
            Plane { facing: Facing::PlusX, offset: low.x, start: low.y, end: high.y },
            Plane { facing: Facing::MinusX, offset: high.x, start: low.y, end: high.y },
            Plane { facing: Facing::PlusY, offset: low.y, start: low.x, end: high.x },
            Plane { facing: Facing::MinusY, offset: high.y, start: low.x, end: high.x },
        ]);
        let start = (0..50).find_map(|_| {
            let place = builder.place();
            let is_start = depth(&builder.planes, place, radius) <= 0.0 && is_free(&builder.planes, place);
            is_start.then_some(place)
        })?;
        let Builder { mut draw, planes, .. } = builder;
        let speed = draw.pick(&[0.0, 0.3, 3.0, 30.0, 1.0e3, 1.0e4]);
        let ball = Ball { position: start, velocity: draw.0.vector() * speed };
        let spec = BallSpec {
            radius: Radius::new(radius).ok()?,
            restitution: draw.pick(&[0.0, 1.0e-3, 0.5, 0.8, 0.8, 0.8, 0.998, 1.0]),
            rolling: if draw.chance(3.0) { BallSpec::ROLLING_SPHERE } else { BallSpec::POINT_MASS },
            resistance: if draw.chance(8.0) { draw.between(0.0, 1.0) } else { 0.0 },
        };
        let held = draw.pick(&[3, 30, 300]);
        let acceleration = draw.pick(&[
            Acceleration::Random,
            Acceleration::Flips(held),
            Acceleration::Turns,
            Acceleration::Axes(held),
            Acceleration::Steady(held),
            Acceleration::Steady(held),
            Acceleration::None,
        ]);
        let strength = draw.pick(&[1.0e-12, 0.3, 3.0, 3.0, 3.0, 9.0, 100.0, 1.0e4, 1.0e6]);
        let tick_s = draw.pick(&[0.03, 0.03, 0.001, 0.1]);
        Some(Self { planes, middle, spec, ball, tick_s, acceleration, strength })
    }

    /// The accelerations of the ticks, for ever.
    pub(crate) fn accelerations(&self, seed: u64) -> impl Iterator<Item = Vector2<f64>> {
        let (mut noise, mut acceleration) = (Noise(!seed), Vector2::zeros());
        let (mode, strength) = (self.acceleration, self.strength);
        (0_u32..).map(move |n| {
            let is_new = |held: u32| n % held == 0;
            match mode {
                Acceleration::Random => acceleration = noise.vector() * strength,
                Acceleration::Flips(held) if is_new(held) => {
                    acceleration =
                        if n % (8 * held) == 0 { noise.vector() * strength } else { -acceleration };
                }
                Acceleration::Turns => {
                    let first = if n == 0 { noise.vector() * strength } else { acceleration };
                    acceleration =
                        Vector2::new(0.995 * first.x - 0.0998 * first.y, 0.0998 * first.x + 0.995 * first.y);
                }
                Acceleration::Axes(held) if is_new(held) => {
                    let size = noise.next() * strength;
                    acceleration =
                        if noise.next() < 0.0 { Vector2::new(size, 0.0) } else { Vector2::new(0.0, size) };
                }
                Acceleration::Steady(held) if is_new(held) => acceleration = noise.vector() * strength,
                _ => {}
            }
            acceleration
        })
    }
}
