//! Text from outside made safe for a line of a message.

/// Longest run of digits, and longest word, that is shown whole (characters).
const MAX_DIGITS: usize = 40;
const MAX_WORD: usize = 300;

/// Longest line (characters): two paths as long as systems take them are shortened, sentences are not.
const MAX_LINE: usize = 1200;

/// One line that a terminal shows as it is: blanks are one space, control characters and those that change the direction of
/// writing are escaped, as in `\u{1b}`, and what is very long is shortened in its middle.
///
/// ```
/// # use maze_core::printable;
/// assert_eq!(printable("a\n\u{1b}[31mb\u{202e}c"), "a \\u{1b}[31mb\\u{202e}c");
/// assert_eq!(printable(&"9".repeat(300)), "999999999999...999999999999 (300 digits)");
/// ```
pub fn printable(text: &str) -> String {
    let mut line = String::with_capacity(text.len().min(4 * MAX_LINE));
    let words = text.split(|c: char| c.is_whitespace() && !is_harmful(c)).filter(|word| !word.is_empty());
    for word in words.take(MAX_LINE) {
        if !line.is_empty() {
            line.push(' ');
        }
        for character in shortened_digits(&shortened(word, MAX_WORD, "characters")).chars() {
            match is_harmful(character) {
                true => line.extend(character.escape_unicode()),
                false => line.push(character),
            }
        }
    }
    shortened(&line, MAX_LINE, "characters")
}

/// Control characters, separators of lines, and marks that turn the direction of what follows.
fn is_harmful(character: char) -> bool {
    (character.is_control() && !matches!(character, '\t' | '\n' | '\r' | '\u{b}' | '\u{c}'))
        || matches!(character, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{61c}' | '\u{feff}')
        || matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// Start and end of what is longer than `most`, with its length.
fn shortened(text: &str, most: usize, unit: &str) -> String {
    let n = text.chars().count();
    if n <= most {
        return text.to_owned();
    }
    let part = most / 3;
    let start: String = text.chars().take(part).collect();
    let end: String = text.chars().skip(n - part).collect();
    format!("{start}...{end} ({n} {unit})")
}

/// Long numbers shortened, wherever they stand in a word.
fn shortened_digits(word: &str) -> String {
    let mut result = String::with_capacity(word.len());
    let mut rest = word;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, tail) = rest.split_at(start);
        let end = tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len());
        let (digits, tail) = tail.split_at(end);
        result.push_str(before);
        if digits.len() <= MAX_DIGITS {
            result.push_str(digits);
        } else {
            let [start, end] = [&digits[..12], &digits[digits.len() - 12..]];
            result.push_str(&format!("{start}...{end} ({} digits)", digits.len()));
        }
        rest = tail;
    }
    result + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn r13_nothing_that_a_terminal_obeys_is_left() {
        let harmful = "\u{0}\u{7}\u{1b}]0;x\u{7}\u{9b}31m\u{7f}\u{85}\u{2028}\u{202e}\u{2066}";
        let line = printable(&format!("a{harmful}b\tc\r\nd"));
        assert!(!line.chars().any(|c| c.is_control() || is_harmful(c)), "{line}");
        assert!(line.starts_with("a\\u{0}\\u{7}\\u{1b}]0;x") && line.ends_with("b c d"), "{line}");
        assert_eq!(printable("  a  b \n"), "a b");
        assert_eq!(printable("\u{8ff7}\u{5bae} \u{e9}"), "\u{8ff7}\u{5bae} \u{e9}");
    }

    #[test]
    fn r17_long_numbers_words_and_lines_are_shortened() {
        let number = format!("scale {} is", "1".repeat(300));
        assert_eq!(printable(&number).len(), "scale 111111111111...111111111111 (300 digits) is".len());
        let word = "x".repeat(4000);
        assert!(printable(&word).ends_with("xxx (4000 characters)") && printable(&word).len() < 300);
        let line = "word ".repeat(4000);
        assert!(printable(&line).len() < 1300);
        assert_eq!(printable(&"7".repeat(40)), "7".repeat(40));
    }
}
