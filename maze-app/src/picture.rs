//! Pictures of mazes: decoded here, within limits, and read by the core.

use crate::loaded::Loaded;
use image::{DynamicImage, GenericImageView, ImageDecoder, ImageFormat, ImageReader, Limits};
use maze_core::AssembleOptions;
use maze_core::import::picture::{self, MAX_PIXELS, WallTone};
use std::io::Cursor;

/// Most bytes that a decoder may ask for: all pixels with four channels of 16 bits, and as much again to work in.
const MAX_BYTES: u64 = 16 * MAX_PIXELS as u64;

/// The maze of a PNG or BMP.
pub(crate) fn maze(
    bytes: &[u8],
    options: &AssembleOptions,
    wall: Option<WallTone>,
) -> Result<Loaded, String> {
    let (width, height, rgb) = colours(bytes)?;
    let picture = picture::read(width, height, &rgb, wall).map_err(|error| error.to_string())?;
    drop(rgb);
    let maze = picture.maze(options).map_err(|error| error.to_string())?;
    let found = format!("{width} x {height} pixels, {}", picture.found());
    Ok(Loaded { maze, found: Some(found) })
}

/// Width, height and the colour of each pixel on white paper, row by row from the top.
fn colours(bytes: &[u8]) -> Result<(usize, usize, Vec<[u8; 3]>), String> {
    if bytes.is_empty() {
        return Err("the file is empty: expected a PNG or BMP picture".to_owned());
    }
    let format = image::guess_format(bytes)
        .ok()
        .filter(|format| matches!(format, ImageFormat::Png | ImageFormat::Bmp));
    let format = format.ok_or("not a PNG or BMP picture")?;
    let name = if format == ImageFormat::Png { "PNG" } else { "BMP" };
    let unreadable = |error: image::ImageError| match &error {
        image::ImageError::IoError(io) if io.kind() == std::io::ErrorKind::UnexpectedEof => {
            format!("the picture is cut off after {} bytes: expected a whole {name}", bytes.len())
        }
        _ => format!("{error}: expected a {name} picture that can be read"),
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_alloc = Some(MAX_BYTES);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(unreadable)?;
    // The header alone is read so far: what it promises is checked before anything is allocated.
    let [width, height] = [decoder.dimensions().0, decoder.dimensions().1].map(|side| side as usize);
    if !width.checked_mul(height).is_some_and(|n_pixels| (1..=MAX_PIXELS).contains(&n_pixels)) {
        return Err(picture::PictureError::Size { width, height }.to_string());
    }
    let image = DynamicImage::from_decoder(decoder).map_err(unreadable)?;
    // A BMP of 32 bits whose fourth byte is 0 everywhere does not use it.
    let is_opaque =
        format == ImageFormat::Bmp && image.pixels().all(|(_, _, image::Rgba(rgba))| rgba[3] == 0);
    let colour = |[r, g, b, alpha]: [u8; 4]| if is_opaque { [r, g, b] } else { on_white([r, g, b, alpha]) };
    Ok((width, height, image.pixels().map(|(_, _, image::Rgba(rgba))| colour(rgba)).collect()))
}

/// A pixel laid over white.
fn on_white([r, g, b, alpha]: [u8; 4]) -> [u8; 3] {
    let alpha = u32::from(alpha);
    [r, g, b].map(|channel| {
        let over = (u32::from(channel) * alpha + 255 * (255 - alpha)) / 255;
        u8::try_from(over).unwrap_or(u8::MAX)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, Luma, Rgba, RgbaImage};

    const WAY: &str = "# ####\n# #  #\n#   ##\n### ##\n";

    fn is_wall(x: u32, y: u32) -> bool {
        WAY.lines().nth(y as usize).unwrap().as_bytes()[x as usize] == b'#'
    }

    fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn png_and_bmp_of_any_depth_are_the_maze_of_the_text() {
        let options = AssembleOptions::default();
        let expected = maze_core::import::text::read(WAY.as_bytes(), &Default::default())
            .unwrap()
            .maze(&options)
            .unwrap();
        let grey =
            GrayImage::from_fn(6 * 4, 4 * 4, |x, y| Luma([if is_wall(x / 4, y / 4) { 20 } else { 240 }]));
        let glass = RgbaImage::from_fn(6, 4, |x, y| Rgba([0, 0, 0, if is_wall(x, y) { 255 } else { 0 }]));
        let (grey, glass) = (DynamicImage::from(grey), DynamicImage::from(glass));
        let wide = DynamicImage::from(grey.to_rgb16());
        for (image, format) in [
            (&grey, ImageFormat::Png),
            (&grey, ImageFormat::Bmp),
            (&DynamicImage::from(grey.to_rgb8()), ImageFormat::Bmp),
            (&wide, ImageFormat::Png),
            (&glass, ImageFormat::Png),
        ] {
            let loaded = maze(&encoded(image, format), &options, None).unwrap();
            assert_eq!(loaded.maze.planes, expected.planes, "{:?} {format:?}", image.color());
            let cell = image.width() / 6;
            let words = format!("6 x 4 cells of {cell} x {cell} pixels");
            assert!(loaded.found.as_ref().unwrap().ends_with(&words), "{:?}", loaded.found);
        }
    }

    #[test]
    fn f21_what_is_wrong_is_said_of_that_file() {
        let error = |bytes: &[u8]| colours(bytes).unwrap_err();
        assert_eq!(error(b""), "the file is empty: expected a PNG or BMP picture");
        for (format, name) in [(ImageFormat::Png, "PNG"), (ImageFormat::Bmp, "BMP")] {
            let bytes = encoded(&DynamicImage::from(GrayImage::new(9, 5)), format);
            let half = &bytes[..bytes.len() - 20];
            let expected =
                format!("the picture is cut off after {} bytes: expected a whole {name}", half.len());
            assert_eq!(error(half), expected);
        }
    }

    #[test]
    fn f21_a_fourth_byte_of_0_everywhere_is_no_transparency() {
        let image = RgbaImage::from_fn(12, 8, |x, y| {
            let tone = if is_wall(x / 2, y / 2) { 0 } else { 255 };
            Rgba([tone, tone, tone, 0])
        });
        let bmp = encoded(&DynamicImage::from(image.clone()), ImageFormat::Bmp);
        let loaded = maze(&bmp, &AssembleOptions::default(), None).unwrap();
        assert!(loaded.found.unwrap().contains("6 x 4 cells of 2 x 2 pixels"));
        // In a PNG it is: nothing is seen.
        let png = encoded(&DynamicImage::from(image), ImageFormat::Png);
        assert!(colours(&png).unwrap().2.iter().all(|pixel| *pixel == [255; 3]));
    }

    #[test]
    fn a_header_that_promises_too_much_is_refused_at_once() {
        let mut png = encoded(&DynamicImage::from(GrayImage::new(8, 8)), ImageFormat::Png);
        let side = 60_000_u32.to_be_bytes();
        png[16..20].copy_from_slice(&side);
        png[20..24].copy_from_slice(&side);
        let mut crc = 0xffff_ffff_u32;
        for byte in &png[12..29] {
            crc ^= u32::from(*byte);
            for _ in 0..8 {
                crc = if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 };
            }
        }
        png[29..33].copy_from_slice(&(!crc).to_be_bytes());
        let expected = "60000 x 60000 pixels: expected at least 1 and at most 4194304 in all";
        let error = colours(&png).unwrap_err();
        assert_eq!(error, expected);
        let mut bmp = encoded(&DynamicImage::from(GrayImage::new(8, 8)), ImageFormat::Bmp);
        bmp[18..22].copy_from_slice(&60_000_u32.to_le_bytes());
        bmp[22..26].copy_from_slice(&60_000_u32.to_le_bytes());
        let error = colours(&bmp).unwrap_err();
        assert_eq!(error, expected);
    }

    #[test]
    fn a_picture_cut_anywhere_is_a_reason_and_never_a_panic() {
        for format in [ImageFormat::Png, ImageFormat::Bmp] {
            let bytes = encoded(&DynamicImage::from(GrayImage::new(9, 5)), format);
            for end in 0..bytes.len() {
                let _ = maze(&bytes[..end], &AssembleOptions::default(), None);
            }
            assert!(colours(&bytes[..bytes.len() / 2]).is_err());
        }
    }
}
