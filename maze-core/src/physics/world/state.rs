//! The state of a ball: position, velocity, and the contacts that support it.

use super::collision::are_opposite;
use super::free_space::FreeSpace;
use crate::physics::ball::{Ball, OutOfRange};
use crate::physics::tolerance;
use crate::physics::wall::Feature;
use nalgebra::Vector2;

/// An active contact: the ball touches the feature, does not move along its normal, and is pressed onto it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// What is touched.
    pub feature: Feature,
    /// Unit normal, from the feature to the ball's centre.
    pub normal: Vector2<f64>,
}

/// At most two active contacts; with two, the ball is at rest. A third adds no constraint in the plane. Of two opposite ones, in a
/// gap without play, only the pressed one is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contacts([Option<Contact>; 2]); // Invariant: the second is `None` where the first is.

/// A ball and its active contacts: all that the motion of the next tick depends on.
///
/// It also remembers a free space around the ball, which saves searches and changes no motion. Two states are equal when balls and
/// contacts are, and both or neither were just placed.
#[derive(Clone, Debug)]
#[repr(C)] // What the usual tick needs comes first.
pub struct BallState {
    pub(super) ball: Ball,
    /// As found at the end of the last tick that was searched, valid for the contacts at that time.
    pub(super) free_space: Option<FreeSpace>,
    /// What it rests on, slides along or rolls around.
    pub(super) contacts: Contacts,
    /// Whether the ball was put here from outside and may lie inside a wall.
    pub(super) is_placed: bool,
    /// Ticks to wait for until the free space is refreshed.
    pub(super) n_ticks_to_wait: u32,
}

impl BallState {
    /// A ball that was placed: it has no contacts until the first tick, which pushes it out of walls that it is in. What it lies
    /// on it then meets as a hit.
    ///
    /// # Errors
    /// A position or velocity that is not finite.
    pub fn new(ball: Ball) -> Result<Self, OutOfRange> {
        Ok(Self {
            ball: ball.checked()?,
            free_space: None,
            contacts: Contacts::default(),
            is_placed: true,
            n_ticks_to_wait: 0,
        })
    }

    /// Where it is and how it moves.
    pub fn ball(&self) -> Ball {
        self.ball
    }

    /// What it rests on, slides along or rolls around.
    pub fn contacts(&self) -> &Contacts {
        &self.contacts
    }
}

impl PartialEq for BallState {
    fn eq(&self, other: &Self) -> bool {
        self.ball == other.ball && self.contacts == other.contacts && self.is_placed == other.is_placed
    }
}

impl Contacts {
    /// Each of them.
    pub fn iter(&self) -> impl Iterator<Item = Contact> {
        self.0.into_iter().flatten()
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.iter().count()
    }

    /// Whether nothing supports the ball.
    pub fn is_empty(&self) -> bool {
        self.0[0].is_none()
    }

    /// Whether two contacts hold the ball.
    pub(super) fn are_two(&self) -> bool {
        self.0[1].is_some()
    }

    /// The contact of a ball that moves along something; the first of two.
    pub(super) fn first(&self) -> Option<&Contact> {
        self.0[0].as_ref()
    }

    pub(super) fn clear(&mut self) {
        self.0 = [None; 2];
    }

    pub(super) fn set(&mut self, contact: Contact) {
        self.0 = [Some(contact), None];
    }

    pub(super) fn set_two(&mut self, contacts: [Contact; 2]) {
        self.0 = contacts.map(Some);
    }

    /// Breaks contacts that the acceleration does not press the ball onto.
    pub(super) fn settle(&mut self, acceleration: Vector2<f64>) {
        if let [Some(one), Some(two)] = self.0 {
            match presses(acceleration, one.normal, two.normal) {
                [true, true] => return,
                [true, false] => self.set(one),
                [false, true] => self.set(two),
                [false, false] => self.clear(),
            }
        }
        // On the arc around a point it depends on the speed too: `roll` decides.
        let is_broken = |contact: &Contact| {
            matches!(contact.feature, Feature::Face(_)) && 0.0 <= acceleration.dot(&contact.normal)
        };
        if self.first().is_some_and(is_broken) {
            self.clear();
        }
    }

    /// The acceleration without what the contacts take: along the support.
    pub(super) fn along(&self, acceleration: Vector2<f64>) -> Vector2<f64> {
        match self.0 {
            [Some(_), Some(_)] => Vector2::zeros(),
            [Some(contact), None] => acceleration - contact.normal * acceleration.dot(&contact.normal),
            _ => acceleration,
        }
    }
}

/// Onto which of two touched features an acceleration presses a ball at rest.
///
/// With a = -(α n₁ + β n₂) it is held by both where α and β are 0 or more. Else the contact with the negative coefficient
/// breaks, and along the other one the ball moves away from it, if it is pressed onto that one at all. Of opposite features, where
/// α and β are not determined, only the one that is pressed more holds it.
pub(super) fn presses(acceleration: Vector2<f64>, one: Vector2<f64>, two: Vector2<f64>) -> [bool; 2] {
    let alone = [one, two].map(|normal| acceleration.dot(&normal) < 0.0);
    let cross = one.perp(&two);
    if are_opposite(one, two) {
        let keeps_one = acceleration.dot(&one) < acceleration.dot(&two);
        return [alone[0] && keeps_one, alone[1] && !keeps_one];
    }
    let rounding = tolerance::CONE * acceleration.norm();
    let side = if cross < 0.0 { -1.0 } else { 1.0 };
    let (alpha, beta) = (side * two.perp(&acceleration), side * acceleration.perp(&one));
    match (-rounding <= alpha, -rounding <= beta) {
        (true, true) => [true, true],
        (true, false) => [alone[0], false],
        (false, true) => [false, alone[1]],
        (false, false) => [false, false],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn contact(x: f64, y: f64) -> Contact {
        let normal = Vector2::new(x, y).normalize();
        Contact { feature: Feature::Point(-normal), normal }
    }

    #[test]
    fn two_contacts_hold_what_presses_onto_both_and_else_the_one_that_is_pressed() {
        let (left, right) = (contact(1.0, 1.0), contact(-1.0, 1.0));
        let held = |x: f64, y: f64| {
            let mut contacts = Contacts::default();
            contacts.set_two([left, right]);
            contacts.settle(Vector2::new(x, y));
            contacts.iter().collect::<Vec<_>>()
        };
        assert_eq!(held(0.0, -1.0), [left, right]);
        assert_eq!(held(0.9, -1.0), [left, right]);
        // Exactly along a normal the other contact is touched without a force.
        assert_eq!(held(1.0, -1.0), [left, right]);
        assert_eq!(held(1.1, -1.0), [right]);
        assert_eq!(held(-1.1, -1.0), [left]);
    }

    #[test]
    fn of_neighbours_on_a_floor_the_one_ahead_supports_the_ball() {
        let (one, two) = (contact(0.0, 1.0), contact(-1.0e-8, 1.0));
        assert_eq!(presses(Vector2::new(0.1, -1.0), one.normal, two.normal), [false, true]);
        assert_eq!(presses(Vector2::new(-0.1, -1.0), one.normal, two.normal), [true, false]);
        // But straight between the normals onto both.
        assert_eq!(presses(Vector2::new(5.0e-9, -1.0), one.normal, two.normal), [true, true]);
        // Two at one place.
        let at_one_place = presses(Vector2::new(0.1, -1.0), one.normal, one.normal);
        assert_eq!(at_one_place.into_iter().filter(|presses| *presses).count(), 1);
    }

    #[test]
    fn between_opposite_contacts_only_the_pressed_one_is_active() {
        let (floor, ceiling) = (contact(0.0, 1.0), contact(0.0, -1.0));
        let mut contacts = Contacts::default();
        contacts.set_two([floor, ceiling]);
        contacts.settle(Vector2::new(1.0, 2.0));
        assert_eq!(contacts.iter().collect::<Vec<_>>(), [ceiling]);
        // However they are pressed: what is left of a wedge is less than a graze.
        let narrower = contact(-4.0e-7, -1.0).normal;
        assert_eq!(presses(Vector2::new(1.0, -1.0e-8), floor.normal, narrower), [false, true]);
    }
}
