//! The report's figures one by one, each with a sentence, on a small maze.

use super::Choice;
use crate::overlay::{Layer, Notes};
use crate::ui::menu::{item, text};
use egui::Ui;

/// A figure: what is shown of the method, its heading, and what a teacher would say.
pub(crate) const STEPS: [(Layer, &str, &str); 6] = [
    (
        Layer::Gravity,
        "Gravity in the plane",
        "The board tilts, gravity does not. Only the part of gravity that lies in the board's plane moves the ball: the steeper the tilt, the longer that arrow.",
    ),
    (
        Layer::Planes,
        "Walls are planes",
        "Each wall is a flat face with a direction in which it looks. There are four directions, so four groups, and in each group the faces are sorted by where they stand.",
    ),
    (
        Layer::Search,
        "Search by bisection",
        "A ball that moves to the right can only meet faces that look left. In that sorted list every comparison halves what is left: 20 comparisons are enough for a million walls.",
    ),
    (
        Layer::Contact,
        "Closest point and penetration",
        "Of the face that was found, the closest point to the ball's centre tells whether they touch, and by how much the ball would be inside the wall.",
    ),
    (
        Layer::Velocity,
        "Reflection",
        "The speed towards the wall is turned round and keeps a fraction of itself, the restitution; the speed along the wall stays.",
    ),
    (
        Layer::Clearance,
        "Free space",
        "Between two walls nothing has to be searched: as long as the ball stays in a box that is known to be empty, it flies on undisturbed.",
    ),
];

pub(super) fn show(ui: &mut Ui, figure: usize, notes: &Notes) -> Option<Choice> {
    let (_, heading, words) = STEPS[figure.min(STEPS.len() - 1)];
    text(ui, &format!("{} of {}   {heading}", figure + 1, STEPS.len()));
    ui.add_space(4.0);
    text(ui, words);
    ui.add_space(4.0);
    notes.show_panels_in(ui);
    let mut choice = None;
    if figure + 1 < STEPS.len() && item(ui, "Next figure", "", "") {
        choice = Some(Choice::Figure(figure + 1));
    }
    if item(ui, "One tick", "0.03 s", "The game stands still; this moves it by one tick.") {
        choice = Some(Choice::OneTick);
    }
    if 0 < figure && item(ui, "Previous figure", "", "") {
        choice = Some(Choice::Figure(figure - 1));
    }
    if item(ui, "Back", "", "") {
        choice = Some(Choice::Back);
    }
    choice
}
