//! Numbers for people.

/// Three digits; very small and very large ones as a power of ten.
pub(crate) fn plain(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 {
        "0".to_owned()
    } else if !(1.0e-3..1.0e6).contains(&size) {
        format!("{value:.1e}")
    } else if size < 1.0 {
        format!("{value:.3}")
    } else if size < 10.0 {
        format!("{value:.2}")
    } else if size < 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.0}")
    }
}

/// A part as percent.
pub(super) fn percent(value: f64) -> String {
    format!("{} %", plain(100.0 * value))
}

/// Seconds.
pub(super) fn duration(value: f64) -> String {
    format!("{} s", plain(value))
}

/// A tick length (s) as people write it.
pub(super) fn tick(tick_s: f64) -> String {
    let per_s = 1.0 / tick_s;
    if (per_s - per_s.round()).abs() < 1.0e-6 && 1.0 < per_s {
        format!("1/{per_s:.0} s")
    } else {
        format!("{tick_s} s")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let told: Vec<String> =
            [0.0, 1.234e-9, 0.01234, 0.5, 3.456, 42.42, 1234.5, 2.0e7].into_iter().map(plain).collect();
        assert_eq!(told, ["0", "1.2e-9", "0.012", "0.500", "3.46", "42.4", "1234", "2.0e7"]);
        assert_eq!([tick(0.03), tick(1.0 / 240.0)], ["0.03 s", "1/240 s"]);
    }
}
