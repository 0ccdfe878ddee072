//! Conversions of numbers for drawing.

/// For drawing.
#[allow(clippy::cast_possible_truncation, reason = "drawing needs no more than f32")]
pub(crate) fn to_f32(value: f64) -> f32 {
    value as f32
}

/// Pixels in the units of the HUD: the window system's scale taken out.
#[allow(clippy::cast_precision_loss, reason = "no window is 2^24 pixels wide")]
pub(crate) fn to_points(pixels: u32, scale: f32) -> f32 {
    pixels as f32 / scale
}
