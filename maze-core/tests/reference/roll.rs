//! Rolling around a point, step by step.

use super::big::{Big, Pair, big, dot, minus, plus};
use super::series::Series;
use super::world::{Feature, Reference};
use std::cmp::Ordering;

/// Parts of a step between which the signs of all conditions are compared.
const SAMPLES: u32 = 4;
/// Halvings of a part: 1e-33 of a step.
const HALVINGS: u32 = 110;

/// What ends a roll.
#[derive(Clone, Copy)]
enum End {
    /// The acceleration no longer presses.
    LiftOff,
    /// The arc ends where this face begins, at its lower or upper end.
    Onto(usize, usize),
    /// Something else is touched.
    Touch(Feature),
}

impl Reference<'_> {
    /// Rolls for one step of the series, to the event that ends the roll, or for the time that is left; returns how long.
    pub(crate) fn roll(&mut self, index: usize, left_s: &Big) -> Big {
        let world = self.world;
        let point = &world.points[index];
        let n = self.contact(Feature::Point(index)).n;
        let turn = (&n[0] * &self.v[1] - &n[1] * &self.v[0]) / &world.r;
        let series = Series::new(&n, &turn, &self.a, &world.r);
        let last = if *left_s < series.step_s { left_s / &series.step_s } else { big(1.0) };
        let ends = self.ends(index);
        let part = &last / big(f64::from(SAMPLES));
        let mut from = big(0.0);
        let margins = |at: &Big| -> Vec<Big> {
            let state = series.at(at);
            ends.iter().map(|end| self.margin(*end, point, &state)).collect()
        };
        let mut before = margins(&from);
        for _ in 0..SAMPLES {
            let to = &from + &part;
            let after = margins(&to);
            let crossed = ends
                .iter()
                .zip(before.iter().zip(&after))
                .filter(|(_, (before, after))| -&world.zero <= **before && **after < -&world.zero);
            let times = crossed.filter_map(|(end, _)| {
                let at = self.bisect(*end, point, &series, [&from, &to]);
                self.is_met(*end, point, &series, &at).then_some((*end, at))
            });
            let first = times.min_by(|(_, a), (_, b)| a.partial_cmp(b).unwrap());
            if let Some((end, at)) = first {
                self.put(point, &series, &at);
                let time_s = &series.step_s * at;
                self.finish(end, &time_s);
                return time_s;
            }
            (from, before) = (to, after);
        }
        self.put(point, &series, &last);
        // Not a product: a rounding of the time that is left would be another step.
        if *left_s < series.step_s { left_s.clone() } else { series.step_s }
    }

    fn put(&mut self, point: &Pair, series: &Series, at: &Big) {
        let (n, turn) = series.at(at);
        self.p = plus(point, &n, &self.world.r);
        let speed = turn * &self.world.r;
        self.v = [-&n[1] * &speed, &n[0] * &speed];
    }

    fn finish(&mut self, end: End, time_s: &Big) {
        match end {
            End::LiftOff => {}
            End::Onto(face, which) => {
                let face = &self.world.faces[face];
                self.p[face.axis] = &face.offset + &face.sign * &self.world.r;
                self.p[1 - face.axis] = face.ends[which].clone();
                self.v[face.axis] = big(0.0);
            }
            End::Touch(feature) => {
                let start_s = self.time_s.clone();
                self.time_s = &start_s + time_s;
                self.bounce(feature);
                self.time_s = start_s;
            }
        }
    }

    /// Everything that can end a roll around a point.
    fn ends(&self, index: usize) -> Vec<End> {
        let point = &self.world.points[index];
        // The centre moves by a diameter at most; its contact lies a radius further.
        let reach = &(&self.world.r * big(3.5));
        let mut ends = vec![End::LiftOff];
        for (n, face) in self.world.faces.iter().enumerate() {
            let which = face.ends.iter().position(|end| *end == point[1 - face.axis]);
            match which.filter(|_| face.offset == point[face.axis]) {
                Some(which) => ends.push(End::Onto(n, which)),
                None if face.gap(&self.p, &self.world.r) < *reach => ends.push(End::Touch(Feature::Face(n))),
                None => {}
            }
        }
        let is_near = |other: &usize| {
            let from = minus(&self.p, &self.world.points[*other]);
            *other != index && from[0].abs() < *reach && from[1].abs() < *reach
        };
        let others = (0..self.world.points.len()).filter(is_near);
        ends.extend(others.map(|other| End::Touch(Feature::Point(other))));
        ends
    }

    /// Positive or 0 while a condition does not hold, negative where it does.
    fn margin(&self, end: End, point: &Pair, (n, turn): &(Pair, Big)) -> Big {
        let world = self.world;
        match end {
            End::LiftOff => -(dot(&self.a, n) + &world.r * turn * turn),
            End::Onto(face, which) => {
                let along = &n[1 - world.faces[face].axis];
                if which == 0 { -along } else { along.clone() }
            }
            End::Touch(Feature::Face(face)) => world.faces[face].gap(&plus(point, n, &world.r), &world.r),
            End::Touch(Feature::Point(other)) => {
                let from = minus(&plus(point, n, &world.r), &world.points[other]);
                dot(&from, &from) - &world.r * &world.r
            }
        }
    }

    /// Whether a face is touched within its extent, or its end reached on its front.
    fn is_met(&self, end: End, point: &Pair, series: &Series, at: &Big) -> bool {
        let (n, _) = series.at(at);
        let faces = &self.world.faces;
        match end {
            End::Touch(Feature::Face(face)) => {
                faces[face].spans(&plus(point, &n, &self.world.r), &self.world.zero)
            }
            End::Onto(face, _) => dot(&n, &faces[face].normal()).sign() == Ordering::Greater,
            _ => true,
        }
    }

    fn bisect(&self, end: End, point: &Pair, series: &Series, [from, to]: [&Big; 2]) -> Big {
        let (mut low, mut high) = (from.clone(), to.clone());
        for _ in 0..HALVINGS {
            let middle = (&low + &high).half();
            let is_below = self.margin(end, point, &series.at(&middle)).sign() == Ordering::Less;
            *(if is_below { &mut high } else { &mut low }) = middle;
        }
        high
    }
}
