//! The frame log as a picture: frames a second and the processor's share over time.

use crate::failure::Failure;
use crate::frame_log::{FrameLog, Rate};
use crate::platform::native::files;
use image::RgbImage;
use plotters::coord::Shift;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use plotters::style::FontStyle;

/// Pixels.
const SIZE: (u32, u32) = (960, 640);

const FONT: &str = "sans-serif";

/// Room above the highest value, as a fraction of it.
const HEADROOM: f64 = 1.15;

/// An SVG.
pub(crate) fn svg(log: &FrameLog, title: &str) -> Result<Vec<u8>, Failure> {
    let mut text = String::new();
    draw(SVGBackend::with_string(&mut text, SIZE).into_drawing_area(), log, title)?;
    Ok(text.into_bytes())
}

/// A PNG.
pub(crate) fn png(log: &FrameLog, title: &str) -> Result<Vec<u8>, Failure> {
    let mut picture = RgbImage::new(SIZE.0, SIZE.1);
    draw(BitMapBackend::with_buffer(&mut picture, SIZE).into_drawing_area(), log, title)?;
    files::png(picture)
}

fn draw<B: DrawingBackend>(area: DrawingArea<B, Shift>, log: &FrameLog, title: &str) -> Result<(), Failure> {
    // The letters come with the HUD: none are needed on the system.
    plotters::style::register_font(FONT, FontStyle::Normal, epaint_default_fonts::UBUNTU_LIGHT)
        .map_err(|_| Failure::bad_input("the built-in font cannot be read"))?;
    let failed = |error: &dyn std::fmt::Display| Failure::bad_input(format!("drawing the plot: {error}"));
    area.fill(&WHITE).map_err(|error| failed(&error))?;
    let area = area.titled(title, (FONT, 18)).map_err(|error| failed(&error))?;
    let (upper, lower) = area.split_vertically(area.dim_in_pixel().1 / 2);
    let rates = log.rates();
    let points = |value: fn(&Rate) -> f64| rates.iter().map(|rate| (rate.at_s, value(rate))).collect();
    graph(&upper, "frames per second", points(|rate| rate.frames_per_s), RGBColor(30, 110, 60))
        .and_then(|()| {
            let percent = points(|rate| rate.processor_percent);
            graph(&lower, "processor, % of one core", percent, RGBColor(180, 70, 20))
        })
        .map_err(|error| failed(&error))?;
    area.present().map_err(|error| failed(&error))
}

fn graph<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    name: &str,
    points: Vec<(f64, f64)>,
    colour: RGBColor,
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let end_s = points.last().map_or(1.0, |(at_s, _)| *at_s);
    let highest = points.iter().map(|(_, value)| *value).fold(1.0, f64::max) * HEADROOM;
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(34)
        .y_label_area_size(56)
        .build_cartesian_2d(0.0..end_s, 0.0..highest)?;
    chart
        .configure_mesh()
        .label_style((FONT, 14))
        .axis_desc_style((FONT, 15))
        .x_desc("seconds")
        .y_desc(name)
        .light_line_style(WHITE)
        .draw()?;
    chart.draw_series(LineSeries::new(points, colour.stroke_width(2)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame_log::Parts;

    #[test]
    fn both_kinds_of_plot_are_drawn_also_of_nothing() {
        let mut log = FrameLog::new(f64::MAX);
        for _ in 0..2 {
            log.push(Parts::default());
            let text = String::from_utf8(svg(&log, "title").unwrap()).unwrap();
            assert!(text.starts_with("<svg") && text.contains("frames per second"));
            let picture = image::load_from_memory(&png(&log, "title").unwrap()).unwrap().into_rgb8();
            assert_eq!(picture.dimensions(), SIZE);
            assert!(picture.pixels().any(|pixel| pixel.0 != [255; 3]), "letters and lines");
        }
    }
}
