//! Bitmaps: which files are taken, and how they become mipmapped textures.

use std::io::Cursor;

use image::RgbImage;

/// Longest side of a texture file. A larger one is a mistake, not a better picture.
const MAX_SIDE: u32 = 8192;

/// Longest side of a PNG, of which a few bytes may promise any number of pixels.
const MAX_PNG_SIDE: u32 = 2048;

/// The three surfaces' pictures; each repeats over its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureSet {
    /// Upright sides of walls.
    pub wall: RgbImage,
    /// What the ball rolls on.
    pub floor: RgbImage,
    /// Upper ends of walls.
    pub top: RgbImage,
}

/// Why a texture file was refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextureError {
    /// The signature is missing.
    #[error(
        "{name}: not a BMP or PNG file (starts with {found}), expected a 24-bit uncompressed BMP or a PNG"
    )]
    NotBmp {
        /// The file's name.
        name: String,
        /// The first bytes, readable.
        found: String,
    },
    /// Another depth of colour.
    #[error("{name}: {bits} bits per pixel, expected a 24-bit uncompressed BMP")]
    BitsPerPixel {
        /// The file's name.
        name: String,
        /// What the header says.
        bits: u16,
    },
    /// Run-length encoded, masked or embedded.
    #[error("{name}: compressed (method {method}), expected a 24-bit uncompressed BMP")]
    Compressed {
        /// The file's name.
        name: String,
        /// What the header says; 0 would be uncompressed.
        method: u32,
    },
    /// A side of zero or too long.
    #[error("{name}: {width} x {height} pixels, expected 1 to {MAX_SIDE} on each side")]
    Size {
        /// The file's name.
        name: String,
        /// What the header says.
        width: i64,
        /// What the header says.
        height: i64,
    },
    /// Fewer bytes than the header promises.
    #[error("{name}: truncated: {found} bytes, expected at least {expected}")]
    Truncated {
        /// The file's name.
        name: String,
        /// From the header.
        expected: u64,
        /// Given.
        found: u64,
    },
    /// Whatever else the decoder dislikes.
    #[error("{name}: {reason}, expected a {kind}")]
    Decode {
        /// The file's name.
        name: String,
        /// What would be taken.
        kind: &'static str,
        /// The decoder's message.
        reason: String,
    },
}

/// Reads a PNG or a 24-bit uncompressed BMP; `name` is for the message. Of a PNG what is transparent is taken as it is.
///
/// The header is checked before anything is allocated, so that no BMP can ask for more memory than the pixels it brings, and
/// no PNG for more than `MAX_PNG_SIDE`² pixels.
///
/// # Errors
///
/// Any [`TextureError`]: what the file is instead, with the numbers from its header.
pub fn decode_texture(name: &str, bytes: &[u8]) -> Result<RgbImage, TextureError> {
    let is_png = bytes.starts_with(b"\x89PNG");
    if !is_png {
        check_header(name, bytes)?;
    }
    let refuse = |e: image::ImageError| TextureError::Decode {
        name: name.to_owned(),
        kind: if is_png { "PNG of at most 2048 x 2048 pixels" } else { "24-bit uncompressed BMP" },
        reason: e.to_string().split_whitespace().collect::<Vec<_>>().join(" "),
    };
    let format = if is_png { image::ImageFormat::Png } else { image::ImageFormat::Bmp };
    let mut reader = image::ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = image::Limits::default();
    let side = if is_png { MAX_PNG_SIDE } else { MAX_SIDE };
    limits.max_image_width = Some(side);
    limits.max_image_height = Some(side);
    limits.max_alloc = Some(8 * u64::from(side) * u64::from(side));
    reader.limits(limits);
    Ok(reader.decode().map_err(refuse)?.into_rgb8())
}

/// File header (14 bytes), then an info header: 12 bytes (OS/2) or 40 and more (Windows).
fn check_header(name: &str, bytes: &[u8]) -> Result<(), TextureError> {
    let name = || name.to_owned();
    if !bytes.starts_with(b"BM") {
        let found = match bytes {
            [] => "nothing: it is empty".to_owned(),
            _ => format!("\"{}\"", bytes[..bytes.len().min(4)].escape_ascii()),
        };
        return Err(TextureError::NotBmp { name: name(), found });
    }
    let truncated = |expected| TextureError::Truncated { name: name(), expected, found: bytes.len() as u64 };
    let u16_at = |at: usize| {
        let field = bytes.get(at..at + 2).and_then(|b| b.try_into().ok());
        field.map(u16::from_le_bytes).ok_or_else(|| truncated(at as u64 + 2))
    };
    let u32_at = |at: usize| {
        let field = bytes.get(at..at + 4).and_then(|b| b.try_into().ok());
        field.map(u32::from_le_bytes).ok_or_else(|| truncated(at as u64 + 4))
    };
    let i32_at = |at: usize| Ok(i64::from(u32_at(at)?.cast_signed()));
    let (pixels_at, header_size) = (u32_at(10)?, u32_at(14)?);
    let is_os2 = header_size == 12;
    let (width, height, bits, method) = if is_os2 {
        (u16_at(18)?.into(), u16_at(20)?.into(), u16_at(24)?, 0)
    } else {
        (i32_at(18)?, i32_at(22)?, u16_at(28)?, u32_at(30)?)
    };
    // A negative height stores the rows from the top.
    let n_rows = height.abs();
    let sides = 1..=i64::from(MAX_SIDE);
    if !sides.contains(&width) || !sides.contains(&n_rows) {
        return Err(TextureError::Size { name: name(), width, height });
    }
    if bits != 24 {
        return Err(TextureError::BitsPerPixel { name: name(), bits });
    }
    if method != 0 {
        return Err(TextureError::Compressed { name: name(), method });
    }
    // Rows are padded to four bytes.
    let n_pixel_bytes = (width * 3 + 3) / 4 * 4 * n_rows;
    let expected = u64::from(pixels_at) + n_pixel_bytes.unsigned_abs();
    if (bytes.len() as u64) < expected { Err(truncated(expected)) } else { Ok(()) }
}

/// What a picture's bytes mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Bytes {
    /// Colours in sRGB, which the texture unit turns into light.
    Decoded,
    /// Colours in sRGB, handed out as they are.
    Srgb,
    /// Numbers.
    Linear,
}

impl Bytes {
    fn format(self) -> wgpu::TextureFormat {
        match self {
            Self::Decoded => wgpu::TextureFormat::Rgba8UnormSrgb,
            Self::Srgb | Self::Linear => wgpu::TextureFormat::Rgba8Unorm,
        }
    }

    fn read(self, byte: u8) -> f32 {
        if self == Self::Linear { f32::from(byte) / 255.0 } else { from_srgb(byte) }
    }

    fn write(self, value: f32) -> u8 {
        if self == Self::Linear { to_byte(value) } else { to_srgb(value) }
    }
}

/// A picture on the GPU with all its mipmaps, and what it looks like from afar.
pub(crate) struct Mipmapped {
    pub(crate) view: wgpu::TextureView,
    /// Mean colour, linear.
    pub(crate) mean: [f32; 3],
    /// A note when the picture was made smaller.
    pub(crate) note: Option<String>,
}

impl Mipmapped {
    /// In `format`, whether the texture unit turns the bytes into light or leaves them in sRGB. Levels wider than the adapter's textures are left out.
    pub(crate) fn new(gpu: &crate::Gpu, name: &str, image: &RgbImage, bytes: Bytes) -> Self {
        let mut levels = mipmaps(image, bytes);
        let note = shrink(&mut levels, name, gpu.max_side());
        let size = |level: &Level| wgpu::Extent3d {
            width: level.width,
            height: level.height,
            depth_or_array_layers: 1,
        };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(name),
            size: size(&levels[0]),
            mip_level_count: u32::try_from(levels.len()).unwrap_or(1),
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: bytes.format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (mip_level, level) in (0..).zip(&levels) {
            gpu.queue.write_texture(
                wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() },
                // As it came: the way to light and back changes nothing, and takes a while.
                &if (level.width, level.height) == image.dimensions() {
                    rgba(image)
                } else {
                    level.rgba(bytes)
                },
                wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(4 * level.width),
                    rows_per_image: None,
                },
                size(level),
            );
        }
        let mean = levels.last().map_or([0.5; 3], |level| level.pixels[0]);
        Self { view: texture.create_view(&Default::default()), mean, note }
    }
}

/// How a surface leans where its picture's light parts stand out and its dark ones, joints and pores, lie deep: red
/// across, green down, 128 is level. Repeats at the edges, as the picture does.
pub(crate) fn normal_map(image: &RgbImage) -> RgbImage {
    let (width, height) = image.dimensions();
    let light = |x: u32, y: u32| {
        let [r, g, b] = image.get_pixel(x % width, y % height).0.map(f32::from);
        (0.3 * r + 0.6 * g + 0.1 * b) / 255.0
    };
    let encode = |slope: f32| to_byte(0.5 + 0.5 * slope);
    RgbImage::from_fn(width, height, |x, y| {
        let across = light(x + 1, y) - light(x + width - 1, y);
        let down = light(x, y + 1) - light(x, y + height - 1);
        image::Rgb([encode(across), encode(down), 0])
    })
}

/// Leaves out the levels that are wider than `max_side`, and notes it.
fn shrink(levels: &mut Vec<Level>, name: &str, max_side: u32) -> Option<String> {
    let n_too_big = levels.iter().take_while(|l| max_side < l.width.max(l.height)).count();
    let left_out = levels.drain(..n_too_big.min(levels.len() - 1)).next();
    let (from, to) = (left_out?, levels.first()?);
    let [from, to] = [&from, to].map(|level| format!("{}x{}", level.width, level.height));
    Some(format!(
        "the {name} texture of {from} pixels is shown at {to}: this adapter takes {max_side} a side"
    ))
}

/// One mipmap level; colours in linear light: averaging sRGB bytes would darken fine detail.
struct Level {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Level {
    fn rgba(&self, bytes: Bytes) -> Vec<u8> {
        let written = |p: &[f32; 3]| p.map(|value| bytes.write(value));
        self.pixels.iter().map(written).flat_map(|[r, g, b]| [r, g, b, u8::MAX]).collect()
    }

    /// Half the size, rounded down; each pixel is the mean of all that it covers, also where a side is odd.
    fn halved(&self) -> Self {
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let covered = |i: u32, n_new: u32, n_old: u32| i * n_old / n_new..((i + 1) * n_old).div_ceil(n_new);
        let mut pixels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            for x in 0..width {
                let mut sum = [0.0_f32; 3];
                let mut n_summed = 0.0;
                for from_y in covered(y, height, self.height) {
                    for from_x in covered(x, width, self.width) {
                        let pixel = self.pixels[(from_y * self.width + from_x) as usize];
                        sum = std::array::from_fn(|i| sum[i] + pixel[i]);
                        n_summed += 1.0;
                    }
                }
                pixels.push(sum.map(|s| s / n_summed));
            }
        }
        Self { width, height, pixels }
    }
}

fn rgba(image: &RgbImage) -> Vec<u8> {
    image.pixels().flat_map(|p| [p[0], p[1], p[2], u8::MAX]).collect()
}

fn mipmaps(image: &RgbImage, bytes: Bytes) -> Vec<Level> {
    // An empty picture has no pixel to show: a single grey one stands in.
    let whole = if image.is_empty() {
        Level { width: 1, height: 1, pixels: vec![[0.5; 3]] }
    } else {
        let light: [f32; 256] = std::array::from_fn(|byte| bytes.read(u8::try_from(byte).unwrap_or(u8::MAX)));
        let pixels = image.pixels().map(|p| p.0.map(|byte| light[usize::from(byte)])).collect();
        Level { width: image.width(), height: image.height(), pixels }
    };
    let mut levels = vec![whole];
    while let Some(last) = levels.last().filter(|l| 1 < l.width.max(l.height)) {
        let next = last.halved();
        levels.push(next);
    }
    levels
}

/// IEC 61966-2-1, one channel, to linear light.
fn from_srgb(byte: u8) -> f32 {
    let c = f32::from(byte) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}

/// The other way, rounded to the nearest byte.
fn to_srgb(linear: f32) -> u8 {
    let c = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    to_byte(c)
}

/// 0 to 1, rounded to the nearest byte.
fn to_byte(value: f32) -> u8 {
    let rounded = (value * 255.0 + 0.5).clamp(0.0, 255.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a byte's range")]
    let byte = rounded as u8;
    byte
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_bytes_survive_linear_light() {
        for byte in 0..=u8::MAX {
            assert_eq!(to_srgb(from_srgb(byte)), byte);
        }
    }

    #[test]
    fn a_bright_brick_rises_from_its_dark_joint() {
        // A joint two pixels wide, then brick.
        let picture = RgbImage::from_fn(8, 4, |x, _| image::Rgb(if x < 2 { [40; 3] } else { [200; 3] }));
        let normal_map = normal_map(&picture);
        assert!(
            150 < normal_map.get_pixel(1, 1)[0] && 150 < normal_map.get_pixel(2, 1)[0],
            "up to the right"
        );
        assert!(normal_map.get_pixel(7, 1)[0] < 100, "down again where the picture repeats");
        assert_eq!(normal_map.get_pixel(5, 1).0, [128, 128, 0], "level");
    }

    #[test]
    fn a_picture_beyond_the_adapter_s_limit_is_made_smaller_and_that_is_said() {
        let picture = RgbImage::new(40, 20);
        let mut levels = mipmaps(&picture, Bytes::Srgb);
        assert_eq!(shrink(&mut levels, "wall", 40), None);
        let note = shrink(&mut levels, "wall", 16).unwrap();
        assert_eq!(note, "the wall texture of 40x20 pixels is shown at 10x5: this adapter takes 16 a side");
        assert_eq!((levels[0].width, levels.len()), (10, 4));
        assert!(shrink(&mut levels, "wall", 0).is_some() && levels.len() == 1, "something is left to show");
    }

    #[test]
    fn mipmaps_average_light_not_bytes() {
        let checker =
            RgbImage::from_fn(6, 5, |x, y| image::Rgb(if (x + y) % 2 == 0 { [255; 3] } else { [0; 3] }));
        let levels = mipmaps(&checker, Bytes::Srgb);
        let sizes: Vec<_> = levels.iter().map(|l| [l.width, l.height]).collect();
        assert_eq!(sizes, [[6, 5], [3, 2], [1, 1]]);
        let last = to_srgb(levels[2].pixels[0][0]);
        assert!((186..=190).contains(&last), "half the light is about 188 of 255, not 128: {last}");
    }
}
