//! The maze of a day: its seed is the date, so that it is the same for everybody.

use super::{Choice, Facts, Start};
use crate::ui::menu::{item, text};
use egui::Ui;
use maze_core::layout::{Algorithm, Recipe};
use std::fmt::{Display, Formatter};

/// A day in UTC.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Date {
    pub(crate) year: i64,
    pub(crate) month: u32,
    pub(crate) day: u32,
}

impl Date {
    /// Of so many days after 1970-01-01, in the Gregorian calendar: Howard Hinnant, "chrono-Compatible Low-Level Date
    /// Algorithms", `civil_from_days`.
    pub(crate) fn of_day(days: i64) -> Self {
        let days = days + 719_468;
        let (era, day_of_era) = (days.div_euclid(146_097), days.rem_euclid(146_097));
        let year_of_era = (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
        let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
        let shifted_month = (5 * day_of_year + 2) / 153;
        let day = day_of_year - (153 * shifted_month + 2) / 5 + 1;
        let month = if shifted_month < 10 { shifted_month + 3 } else { shifted_month - 9 };
        let year = year_of_era + era * 400 + i64::from(month <= 2);
        let small = |number: i64| u32::try_from(number).unwrap_or(1);
        Self { year, month: small(month), day: small(day) }
    }

    /// The maze of the day. The algorithms take turns.
    pub(crate) fn recipe(self) -> Recipe {
        let seed = u64::try_from(self.year).unwrap_or(0) * 10_000 + u64::from(100 * self.month + self.day);
        let algorithm = Algorithm::ALL[(self.day as usize) % Algorithm::ALL.len()];
        Recipe { braid: 0.2, ..Recipe::new(14, 9, algorithm, seed) }
    }
}

impl Display for Date {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{:04}-{:02}-{:02}", self.year, self.month, self.day)
    }
}

pub(super) fn show(ui: &mut Ui, facts: &Facts<'_>) -> Option<Choice> {
    text(ui, &format!("The maze of {} (UTC), the same for everybody.", facts.today));
    let is_chosen = item(ui, "Play", "", "Roll the ball from the ring to the goal.");
    is_chosen.then_some(Choice::Play(Start::Daily(facts.today)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_those_of_the_calendar_and_each_has_a_maze_of_its_own() {
        for (days, text) in [
            (0, "1970-01-01"),
            (-1, "1969-12-31"),
            (11_016, "2000-02-29"),
            (20_783, "2026-11-26"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(Date::of_day(days).to_string(), text);
        }
        let recipes: Vec<Recipe> = (20_000..20_400).map(|days| Date::of_day(days).recipe()).collect();
        for (i, recipe) in recipes.iter().enumerate() {
            assert!(!recipes[..i].contains(recipe));
        }
        assert_eq!(recipes[0].seed, 20_241_004);
    }
}
