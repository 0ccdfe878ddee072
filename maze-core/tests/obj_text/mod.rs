//! Boxes as OBJ text.

/// A closed box as OBJ text; corners count on from `base`.
pub(crate) fn block(base: usize, low: [f64; 3], high: [f64; 3]) -> String {
    let mut text = String::new();
    for corner in 0..8 {
        let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
        text += &format!("v {} {} {}\n", pick(0), pick(1), pick(2));
    }
    for face in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        let [a, b, c, d] = face.map(|corner| corner + base);
        text += &format!("f {a} {b} {c} {d}\n");
    }
    text
}
