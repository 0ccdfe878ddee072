//! Motion on a parabola: flight, and sliding along a face.

use super::big::{Big, Pair, big, dot, length, minus, plus};
use super::crossing;
use super::world::{Face, Feature, Reference};

impl Reference<'_> {
    /// Flies to the first touch, or for the time that is left; returns how long.
    pub(crate) fn fly(&mut self, left_s: &Big) -> Big {
        let first = self.first_touch(&self.a, left_s, None);
        let time_s = first.as_ref().map_or_else(|| left_s.clone(), |(_, time_s)| time_s.clone());
        self.fall(&self.a.clone(), &time_s);
        if let Some((feature, _)) = first {
            self.arrive(feature, &time_s);
        }
        time_s
    }

    /// Slides to the first touch, over the end of the face, or for the time that is left; returns how long.
    pub(crate) fn slide(&mut self, index: usize, left_s: &Big) -> Big {
        let face = &self.world.faces[index];
        let (axis, along) = (face.axis, 1 - face.axis);
        self.v[axis] = big(0.0);
        self.p[axis] = &face.offset + &face.sign * &self.world.r;
        let mut a = self.a.clone();
        a[axis] = big(0.0);
        let (p, v) = (&self.p[along], &self.v[along]);
        let low = crossing::parabola(&(p - &face.ends[0]), v, &a[along], &self.world.zero);
        let high = crossing::parabola(&(&face.ends[1] - p), &-v, &-&a[along], &self.world.zero);
        let (mut time_s, mut end) = (left_s.clone(), None);
        for (found_s, at) in [(low, &face.ends[0]), (high, &face.ends[1])] {
            if let Some(found_s) = found_s.filter(|found_s| *found_s < time_s) {
                (time_s, end) = (found_s, Some(at.clone()));
            }
        }
        let hit = self.first_touch(&a, &time_s, Some(index));
        if let Some((_, hit_s)) = &hit {
            time_s = hit_s.clone();
        }
        self.fall(&a, &time_s);
        match (hit, end) {
            (Some((feature, _)), _) => self.arrive(feature, &time_s),
            (None, Some(end)) => self.p[along] = end,
            (None, None) => {}
        }
        time_s
    }

    fn fall(&mut self, a: &Pair, time_s: &Big) {
        let half = time_s.clone().half();
        self.p = plus(&self.p, &plus(&self.v, a, &half), time_s);
        self.v = plus(&self.v, a, time_s);
    }

    /// A hit at the end of a stretch that began at `self.time_s`.
    fn arrive(&mut self, feature: Feature, after_s: &Big) {
        if let Feature::Face(index) = feature {
            let face = &self.world.faces[index];
            self.p[face.axis] = &face.offset + &face.sign * &self.world.r;
        }
        let start_s = self.time_s.clone();
        self.time_s = &start_s + after_s;
        self.bounce(feature);
        self.time_s = start_s;
    }

    /// The first feature touched within a time, by a look at each; `along` is the face on which the ball slides.
    fn first_touch(&self, a: &Pair, left_s: &Big, along: Option<usize>) -> Option<(Feature, Big)> {
        let (world, mut first, mut horizon) = (self.world, None, left_s.clone());
        let ground = along.map(|index| &world.faces[index]);
        let is_coplanar = |face: &Face| {
            ground.is_some_and(|ground| face.axis == ground.axis && face.offset == ground.offset)
        };
        // A part in a million more than the ball can move in a time.
        let reach = |time_s: &Big| {
            let time_s = time_s.f64();
            1.000_001 * (length(&self.v) + length(a) * time_s / 2.0) * time_s + 1.0e-6 * world.r.f64()
        };
        for (index, face) in world.faces.iter().enumerate().filter(|(_, face)| !is_coplanar(face)) {
            let gap = face.gap(&self.p, &world.r);
            if reach(&horizon) < gap.f64().abs() {
                continue;
            }
            let (v, a_n) = (&face.sign * &self.v[face.axis], &face.sign * &a[face.axis]);
            let found_s = crossing::parabola(&gap, &v, &a_n, &world.zero);
            let Some(found_s) = found_s.filter(|found_s| *found_s < horizon) else { continue };
            let at = plus(&self.p, &plus(&self.v, a, &found_s.clone().half()), &found_s);
            if face.spans(&at, &world.zero) {
                (first, horizon) = (Some(Feature::Face(index)), found_s);
            }
        }
        for (index, point) in world.points.iter().enumerate() {
            let is_far = reach(&horizon) + world.r.f64() < length(&minus(&self.p, point));
            if is_far || ground.is_some_and(|ground| point[ground.axis] == ground.offset) {
                continue;
            }
            if let Some(found_s) = crossing::quartic(&self.distance(point, a), &horizon) {
                (first, horizon) = (Some(Feature::Point(index)), found_s);
            }
        }
        first.map(|feature| (feature, horizon))
    }

    /// |c(t) - point|² - r² as a polynomial; where the ball touches the point and leaves it, divided by the powers of t that it
    /// holds.
    fn distance(&self, point: &Pair, a: &Pair) -> [Big; 5] {
        let d = minus(&self.p, point);
        let mut terms = [
            dot(&d, &d) - &self.world.r * &self.world.r,
            big(2.0) * dot(&d, &self.v),
            dot(&self.v, &self.v) + dot(&d, a),
            dot(&self.v, a),
            dot(a, a) * big(0.25),
        ];
        for _ in 0..3 {
            if !self.world.is_zero(&terms[0]) {
                break;
            }
            terms.rotate_left(1);
            terms[4] = big(0.0);
        }
        terms
    }
}
