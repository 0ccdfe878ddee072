//! Lines, arrows, rings and wall faces as the renderer's lines and patches.

use super::{Colour, QUIET};
use crate::numbers::to_f32;
use maze_core::{Bounds, Plane};
use maze_render::{Line, Patch};
use nalgebra::{Point3, Vector2, Vector3};
use std::f64::consts::TAU;

/// Corners of a ring.
const N_RING: u32 = 48;

/// An arrow's head, as a fraction of the arrow, and at most in units.
const HEAD_FRACTION: f64 = 0.3;
const MAX_HEAD: f64 = 0.18;

/// Length of a dash (units).
const DASH: f64 = 0.12;

/// Distance of the lines on an empty board (units).
const GRID: f64 = 1.0;

/// Most lines of the empty board each way.
const MAX_GRID_LINES: u32 = 200;

/// How much the lines of an empty board cover.
const FAINT: u8 = 60;

pub(super) struct Pen {
    pub(super) lines: Vec<Line>,
    pub(super) patches: Vec<Patch>,
    /// Where the eye is, maze frame.
    eye: Point3<f64>,
    wall_height: f64,
}

impl Pen {
    pub(super) fn new(eye: Point3<f64>, wall_height: f64) -> Self {
        Self { lines: Vec::new(), patches: Vec::new(), eye, wall_height }
    }

    pub(super) fn line(&mut self, from: Vector3<f64>, to: Vector3<f64>, width: f32, colour: Colour) {
        self.line_covering(from, to, width, colour, u8::MAX);
    }

    fn line_covering(&mut self, from: Vector3<f64>, to: Vector3<f64>, width: f32, [r, g, b]: Colour, a: u8) {
        let [from, to] = [from, to].map(|end| end.map(to_f32).into());
        self.lines.push(Line { from, to, width, colour: [r, g, b, a] });
    }

    pub(super) fn dashed(&mut self, from: Vector3<f64>, to: Vector3<f64>, width: f32, colour: Colour) {
        let line = to - from;
        let n_dashes = (line.norm() / (2.0 * DASH)).ceil().clamp(1.0, 100.0);
        let mut begin = 0.0;
        while begin < n_dashes {
            let at = |fraction: f64| from + line * (fraction / n_dashes);
            self.line(at(begin), at(begin + 0.5), width, colour);
            begin += 1.0;
        }
    }

    /// From a point along a vector; the head lies flat on the board, or upright where the arrow does.
    pub(super) fn arrow(&mut self, from: Vector3<f64>, vector: Vector3<f64>, width: f32, colour: Colour) {
        let Some(along) = vector.try_normalize(0.0) else { return };
        let tip = from + vector;
        let head = (HEAD_FRACTION * vector.norm()).min(MAX_HEAD);
        let flat = Vector3::new(-along.y, along.x, 0.0);
        let across = if along.z.abs() < 0.7 { flat.normalize() } else { Vector3::x() };
        let foot = tip - along * head;
        self.line(from, foot, width, colour);
        let [left, right] = [0.5, -0.5].map(|side| foot + across * (side * head));
        self.patch([tip, left, foot, right], u8::MAX, colour);
    }

    pub(super) fn ring(&mut self, centre: Vector3<f64>, radius: f64, width: f32, colour: Colour) {
        let at = |n: u32| {
            let (sin, cos) = (TAU * f64::from(n) / f64::from(N_RING)).sin_cos();
            centre + Vector3::new(cos, sin, 0.0) * radius
        };
        for n in 0..N_RING {
            self.line(at(n), at(n + 1), width, colour);
        }
    }

    /// A small square on its point.
    pub(super) fn dot(&mut self, centre: Vector3<f64>, radius: f64, colour: Colour) {
        let corners = [Vector3::x(), Vector3::y(), -Vector3::x(), -Vector3::y()];
        self.patch(corners.map(|corner| centre + corner * radius), u8::MAX, colour);
    }

    /// A wall face: its upper edge, and the face itself where it is seen from the front.
    pub(super) fn face(&mut self, plane: &Plane, width: f32, alpha: u8, colour: Colour) {
        let [start, end] = [plane.start, plane.end].map(|along| plane.facing.point(plane.offset, along));
        let [low, high] = [0.0, self.wall_height];
        self.line(start.push(high), end.push(high), width, colour);
        let axis = plane.facing.axis();
        if 0.0 < (self.eye[axis] - plane.offset) * plane.facing.sign() {
            self.patch([start.push(low), end.push(low), end.push(high), start.push(high)], alpha, colour);
        }
    }

    /// An upright pane as high as the walls, seen from both sides.
    pub(super) fn pane(&mut self, ends: [Vector2<f64>; 2], alpha: u8, colour: Colour) {
        let ([start, end], high) = (ends, self.wall_height);
        let corners = [start.push(0.0), end.push(0.0), end.push(high), start.push(high)];
        self.patch(corners, alpha, colour);
        for n in 0..4 {
            self.line(corners[n], corners[(n + 1) % 4], 1.5, colour);
        }
    }

    /// Where the maze would be: faint lines a unit apart.
    pub(super) fn board(&mut self, bounds: &Bounds) {
        let (low, high) = (bounds.low, bounds.high);
        for axis in [0, 1] {
            let n_gaps = (bounds.size()[axis] / GRID).round().clamp(1.0, f64::from(MAX_GRID_LINES));
            let mut n = 0.0;
            while n <= n_gaps {
                let (mut from, mut to) = (low.push(0.0), high.push(0.0));
                from[axis] = low[axis] + bounds.size()[axis] * n / n_gaps;
                to[axis] = from[axis];
                let is_edge = n == 0.0 || n == n_gaps;
                let (width, alpha) = if is_edge { (2.5, 3 * FAINT) } else { (1.0, FAINT) };
                self.line_covering(from, to, width, QUIET, alpha);
                n += 1.0;
            }
        }
    }

    fn patch(&mut self, corners: [Vector3<f64>; 4], alpha: u8, [r, g, b]: Colour) {
        let corners = corners.map(|corner| corner.map(to_f32).into());
        self.patches.push(Patch { corners, colour: [r, g, b, alpha] });
    }
}
