//! Numbers in attributes: coordinates, lists of points, transforms and path data.

/// Coordinates beyond this are no drawing; their differences stay finite.
const MAX_COORDINATE: f64 = 1.0e12;

/// One number, with or without `px`.
pub(super) fn length(text: &str) -> Option<f64> {
    let text = text.trim();
    usable(text.strip_suffix("px").unwrap_or(text))
}

fn usable(text: &str) -> Option<f64> {
    text.parse().ok().filter(|value: &f64| value.abs() <= MAX_COORDINATE)
}

/// What comes next in a list of numbers or path data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Token {
    Number(f64),
    Command(char),
    /// Neither; the list ends here.
    Wrong,
}

/// Tokens of path data: `M10-5.5.5h3` are M, 10, -5.5, .5, h, 3.
pub(super) struct Tokens<'a>(pub(super) &'a str);

impl Iterator for Tokens<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        self.0 = self.0.trim_start_matches(|c: char| c.is_ascii_whitespace() || c == ',');
        let first = self.0.chars().next()?;
        if first.is_ascii_alphabetic() {
            self.0 = &self.0[1..];
            return Some(Token::Command(first));
        }
        let (number, rest) = self.0.split_at(number_length(self.0.as_bytes()));
        let token = usable(number).map_or(Token::Wrong, Token::Number);
        self.0 = if token == Token::Wrong { "" } else { rest };
        Some(token)
    }
}

/// Bytes that the number at the start takes: sign, digits, point, digits, exponent.
fn number_length(bytes: &[u8]) -> usize {
    let digits = |from: usize| from + bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let sign = |at: usize| at + usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));
    let mut end = digits(sign(0));
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = sign(end + 1);
        if digits(exponent) != exponent {
            end = digits(exponent);
        }
    }
    end
}

/// A list of points; `None` when it is something else. After one more than `most` it is not read on.
pub(super) fn points(text: &str, most: usize) -> Option<Vec<[f64; 2]>> {
    let mut tokens = Tokens(text);
    let mut points = Vec::new();
    while let Some(x) = tokens.next() {
        let (Token::Number(x), Some(Token::Number(y))) = (x, tokens.next()) else { return None };
        points.push([x, y]);
        if most < points.len() {
            break;
        }
    }
    Some(points)
}

/// x' = a x + c y + e, y' = b x + d y + f.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform(pub(super) [f64; 6]);

impl Transform {
    pub(super) const IDENTITY: Self = Self([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);

    pub(super) fn apply(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [a, b, c, d, e, f] = self.0;
        [a * x + c * y + e, b * x + d * y + f]
    }

    /// This transform after another one.
    pub(super) fn after(&self, inner: &Self) -> Self {
        let [a, b, c, d, _, _] = self.0;
        let [ia, ib, ic, id, ie, jf] = inner.0;
        let [e, f] = self.apply([ie, jf]);
        Self([a * ia + c * ib, b * ia + d * ib, a * ic + c * id, b * ic + d * id, e, f])
    }

    /// This transform after those of an attribute; `None` where it is none.
    pub(super) fn after_list(&self, text: &str) -> Option<Self> {
        let svgtypes::Transform { a, b, c, d, e, f } = text.parse().ok()?;
        let all = self.after(&Self([a, b, c, d, e, f]));
        all.0.iter().all(|value| value.is_finite() && value.abs() <= MAX_COORDINATE).then_some(all)
    }

    /// A translation.
    pub(super) fn moved([x, y]: [f64; 2]) -> Self {
        Self([1.0, 0.0, 0.0, 1.0, x, y])
    }

    /// By how much it makes things larger, in the mean of both axes.
    pub(super) fn mean_scale(&self) -> f64 {
        let [a, b, c, d, _, _] = self.0;
        ((a * a + b * b).sqrt() + (c * c + d * d).sqrt()) / 2.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_data_needs_no_separators() {
        let tokens: Vec<Token> = Tokens("M10-5.5.5h3,-1e1z").collect();
        let number = Token::Number;
        let expected = [
            Token::Command('M'),
            number(10.0),
            number(-5.5),
            number(0.5),
            Token::Command('h'),
            number(3.0),
            number(-10.0),
            Token::Command('z'),
        ];
        assert_eq!(tokens, expected);
        assert_eq!(Tokens("3 # 4").collect::<Vec<_>>(), [number(3.0), Token::Wrong]);
        assert_eq!(Tokens("1e999").collect::<Vec<_>>(), [Token::Wrong]);
        assert_eq!(Tokens("\u{e9}").collect::<Vec<_>>(), [Token::Wrong]);
    }

    #[test]
    fn lengths_and_points() {
        assert_eq!(length(" 12.5px "), Some(12.5));
        for bad in ["", "nan", "inf", "1e13", "50%", "1 2", "px"] {
            assert_eq!(length(bad), None, "{bad}");
        }
        assert_eq!(points("1,2 3 4", 9), Some(vec![[1.0, 2.0], [3.0, 4.0]]));
        assert_eq!(points("", 9), Some(vec![]));
        assert_eq!(points("1,2 3", 9), None);
        assert_eq!(points("1,2 L 3 4", 9), None);
    }

    #[test]
    fn transforms_apply_from_right_to_left() {
        let both = Transform::IDENTITY.after_list("translate(10, 20) scale(2)").unwrap();
        assert_eq!(both.apply([1.0, 3.0]), [12.0, 26.0]);
        let matrix = both.after_list(" matrix(0 1 -1 0 5 0) , translate(1)").unwrap();
        assert_eq!(matrix.apply([1.0, 3.0]), [14.0, 24.0]);
        for bad in ["turn(45)", "scale(a)", "scale", "scale(1", "scale(nan)", "scale(1e200) scale(1e200)"] {
            assert_eq!(Transform::IDENTITY.after_list(bad), None, "{bad}");
        }
    }
}
