//! Letters for names in any script: the built-in fonts have Latin, Greek and Cyrillic, all others come from the system's.
//!
//! The system's fonts are looked for when the first letter is missing, and only those that have one are read, so that a
//! game with Latin names alone reads none. What no font has is written as its number in Unicode. egui shapes letters (so
//! Arabic is joined) and puts a run of right-to-left letters in order, but it does not reorder runs of mixed directions:
//! a name of both is shown in the order in which it is stored.

use egui::epaint::text::{FallbackRequest, FontInsert, FontPriority, InsertFontFamily};
use egui::{Context, FontData, FontFamily, FontId};
use fontdb::{Database, FaceInfo, Source};
use skrifa::{FontRef, MetadataProvider};
use std::fmt::Write;
use std::sync::{Arc, OnceLock};

/// Larger font files are left alone (bytes); collections of all Chinese, Japanese and Korean letters have 20 to 120 MB.
const MAX_FONT_BYTES: u64 = 160 << 20;

/// Most letters of a name that are shown; the middle of a longer one is left out.
const MAX_LETTERS: usize = 40;

/// Most missing letters in a row that are written as numbers.
const MAX_NUMBERS: usize = 4;

/// Once for a context: what is missing is looked for among the system's fonts.
pub(super) fn add_system_fonts(context: &Context) {
    context.add_font_provider(Arc::new(|request: &FallbackRequest<'_>| {
        static FONTS: OnceLock<Database> = OnceLock::new();
        let fonts = FONTS.get_or_init(|| {
            let mut fonts = Database::new();
            fonts.load_system_fonts();
            fonts
        });
        font_with(fonts, request.cluster.chars().next()?, request.family)
    }));
}

/// A font with the letter; plain faces first, so that a name is not set in bold italics.
fn font_with(fonts: &Database, letter: char, family: &FontFamily) -> Option<FontInsert> {
    let plainness = |face: &&FaceInfo| {
        let upright = face.style == fontdb::Style::Normal;
        (!upright, face.weight.0.abs_diff(fontdb::Weight::NORMAL.0), face.monospaced)
    };
    let mut faces: Vec<&FaceInfo> = fonts.faces().collect();
    faces.sort_by_key(plainness);
    faces.into_iter().find_map(|face| {
        let Source::File(path) = &face.source else { return None };
        let is_small = std::fs::metadata(path).is_ok_and(|file| file.len() <= MAX_FONT_BYTES);
        let bytes = is_small.then(|| std::fs::read(path).ok()).flatten()?;
        let font = FontRef::from_index(&bytes, face.index).ok()?;
        // Not a picture in colours, which cannot be drawn.
        font.outline_glyphs().get(font.charmap().map(letter)?)?;
        let mut data = FontData::from_owned(bytes);
        data.index = face.index;
        let families = vec![InsertFontFamily { family: family.clone(), priority: FontPriority::Lowest }];
        Some(FontInsert { name: format!("{} {}", face.post_script_name, face.index), data, families })
    })
}

/// A text as it can be shown: letters that no font has, and those that have no shape or turn the text around them, as
/// numbers in square brackets.
pub(crate) fn readable(context: &Context, text: &str) -> String {
    let font = FontId::new(14.0, FontFamily::Proportional);
    context.fonts_mut(|fonts| numbered(text, |letter| fonts.has_glyph(&font, letter)))
}

/// The same, and not longer than fits.
pub(super) fn readable_name(context: &Context, name: &str) -> String {
    readable(context, &shortened(name))
}

/// A name for the window's frame, which has fonts of its own.
pub(crate) fn window_title(name: &str) -> String {
    numbered(&shortened(name), |_| true)
}

/// A name without its middle: what it begins with, and its ending.
fn shortened(name: &str) -> String {
    let n = name.chars().count();
    if n <= MAX_LETTERS {
        return name.to_owned();
    }
    let half = MAX_LETTERS / 2;
    name.chars().take(half).chain(['…']).chain(name.chars().skip(n - half)).collect()
}

fn numbered(text: &str, mut has_shape: impl FnMut(char) -> bool) -> String {
    let mut shown = String::with_capacity(text.len());
    let mut missing: Vec<char> = Vec::new();
    for letter in text.chars() {
        // Between other letters these only control how they join.
        let joins = matches!(letter, '\u{200c}' | '\u{200d}' | '\u{fe00}'..='\u{fe0f}');
        if letter == ' ' || joins || !has_no_shape(letter) && has_shape(letter) {
            write_numbers(&mut shown, &mut missing);
            shown.push(letter);
        } else {
            missing.push(letter);
        }
    }
    write_numbers(&mut shown, &mut missing);
    shown
}

/// Control letters, and those that turn the text behind them around.
fn has_no_shape(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

fn write_numbers(shown: &mut String, missing: &mut Vec<char>) {
    if missing.is_empty() {
        return;
    }
    let numbers: Vec<String> =
        missing.iter().take(MAX_NUMBERS).map(|c| format!("U+{:04X}", u32::from(*c))).collect();
    // Writing to a string cannot fail.
    let _ = match missing.len().checked_sub(MAX_NUMBERS).filter(|more| 0 < *more) {
        Some(more) => write!(shown, "[{} and {more} more]", numbers.join(" ")),
        None => write!(shown, "[{}]", numbers.join(" ")),
    };
    missing.clear();
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A context whose fonts are there, as in a frame.
    fn context() -> Context {
        let context = Context::default();
        add_system_fonts(&context);
        let mut output = context.run_ui(egui::RawInput::default(), |_| {});
        output.textures_delta.set.drain().for_each(drop);
        context
    }

    #[test]
    fn i8_what_no_font_has_is_written_as_numbers() {
        let latin = |letter: char| letter.is_ascii();
        assert_eq!(numbered("maze-2.txt", latin), "maze-2.txt");
        assert_eq!(numbered("迷路.txt", latin), "[U+8FF7 U+8DEF].txt");
        assert_eq!(numbered("a متاهة b", latin), "a [U+0645 U+062A U+0627 U+0647 and 1 more] b");
        assert_eq!(numbered("", latin), "");
    }

    #[test]
    fn i8_letters_without_a_shape_are_seen() {
        assert_eq!(numbered("a\nb\u{202e}txt", |_| true), "a[U+000A]b[U+202E]txt");
        assert_eq!(numbered("می\u{200c}شود", |_| true), "می\u{200c}شود");
    }

    #[test]
    fn i8_a_long_name_keeps_its_ending() {
        let name = format!("{}.svg", "迷".repeat(80));
        let short = shortened(&name);
        assert_eq!(short.chars().count(), MAX_LETTERS + 1);
        assert!(short.ends_with("迷.svg") && short.contains('…'));
    }

    #[test]
    fn i8_every_name_is_shown_with_glyphs_or_numbers() {
        let context = context();
        for name in [
            "maze",
            "лабиринт",
            "λαβύρινθος",
            "Žluťoučký",
            "迷路",
            "미로",
            "متاهة",
            "מבוך",
            "เขาวงกต",
            "भूलभुलैया",
            "🏁",
        ] {
            let shown = readable_name(&context, name);
            let font = FontId::new(14.0, FontFamily::Proportional);
            assert!(context.fonts_mut(|fonts| fonts.has_glyphs(&font, &shown)), "{name}: {shown}");
            assert!(shown == name || shown.contains("U+"), "{name}: {shown}");
        }
        for name in ["maze", "лабиринт", "λαβύρινθος"] {
            assert_eq!(readable_name(&context, name), name, "the built-in fonts have it");
        }
    }

    #[test]
    fn i8_files_that_are_no_fonts_are_passed_over() {
        let directory = tempfile::tempdir().unwrap();
        std::fs::write(directory.path().join("a.ttf"), b"no font").unwrap();
        let mut fonts = Database::new();
        fonts.load_fonts_dir(directory.path());
        assert!(font_with(&fonts, '迷', &FontFamily::Proportional).is_none());
    }
}
