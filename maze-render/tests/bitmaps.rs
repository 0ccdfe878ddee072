//! Which bitmaps are taken as textures, and what is said of the others.

use maze_render::decode_texture;

/// A Windows bitmap: file header, 40-byte info header, rows from the bottom, padded to four bytes.
fn bmp(width: i32, height: i32, bits: u16, compression: u32, pixels: &[u8]) -> Vec<u8> {
    let size = 54 + u32::try_from(pixels.len()).expect("small");
    let mut bytes = b"BM".to_vec();
    for word in [size, 0, 54, 40, width.cast_unsigned(), height.cast_unsigned()] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(1_u16.to_le_bytes());
    bytes.extend(bits.to_le_bytes());
    for word in [compression, 0, 2835, 2835, 0, 0] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend(pixels);
    bytes
}

/// Bottom row: blue, green; top row: red, white.
const TWO_BY_TWO: [u8; 16] = [255, 0, 0, 0, 255, 0, 0, 0, 0, 0, 255, 255, 255, 255, 0, 0];

fn refusal(bytes: &[u8]) -> String {
    let text = decode_texture("wall.bmp", bytes).expect_err("should be refused").to_string();
    assert!(text.starts_with("wall.bmp: ") && !text.contains('\n'), "{text}");
    text
}

#[test]
fn a_24_bit_bitmap_is_read_the_right_way_up() {
    let image = decode_texture("wall.bmp", &bmp(2, 2, 24, 0, &TWO_BY_TWO)).unwrap();
    assert_eq!(image.dimensions(), (2, 2));
    assert_eq!(image.get_pixel(0, 0).0, [255, 0, 0]);
    assert_eq!(image.get_pixel(1, 0).0, [255, 255, 255]);
    assert_eq!(image.get_pixel(0, 1).0, [0, 0, 255]);
    let from_top = decode_texture("wall.bmp", &bmp(2, -2, 24, 0, &TWO_BY_TWO)).unwrap();
    assert_eq!(from_top.get_pixel(0, 0).0, [0, 0, 255], "a negative height stores the top row first");
}

#[test]
fn f20_a_png_is_a_texture_too() {
    const TONES: [u8; 3] = [0, 10, 20];
    let tone = |at: u32| TONES[at as usize];
    let picture = image::RgbaImage::from_fn(3, 2, |x, y| image::Rgba([tone(x), tone(2 * y), 7, 255]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    let texture = decode_texture("wall.png", bytes.get_ref()).unwrap();
    assert_eq!((texture.dimensions(), texture.get_pixel(2, 1).0), ((3, 2), [20, 20, 7]));
}

#[test]
fn what_is_not_a_bitmap_is_named() {
    assert_eq!(
        refusal(b"GIF89a rest"),
        "wall.bmp: not a BMP or PNG file (starts with \"GIF8\"), expected a 24-bit uncompressed BMP or a PNG"
    );
    assert!(refusal(b"\x89PNG\r\n\x1a\n rest").contains("expected a PNG of at most 2048 x 2048 pixels"));
    assert!(refusal(b"").contains("empty"));
    assert!(refusal(b"B").contains("not a BMP"));
}

#[test]
fn other_depths_and_compression_are_named() {
    let text = refusal(&bmp(4, 4, 8, 0, &[0; 1024 + 16]));
    assert_eq!(text, "wall.bmp: 8 bits per pixel, expected a 24-bit uncompressed BMP");
    assert!(refusal(&bmp(2, 2, 32, 0, &[0; 16])).contains("32 bits"));
    assert!(refusal(&bmp(2, 2, 24, 1, &TWO_BY_TWO)).contains("compressed (method 1)"));
}

#[test]
fn absurd_sizes_are_refused_before_memory_is_asked_for() {
    assert!(refusal(&bmp(i32::MAX, i32::MAX, 24, 0, &TWO_BY_TWO)).contains("2147483647 x 2147483647"));
    assert!(refusal(&bmp(2, i32::MIN, 24, 0, &TWO_BY_TWO)).contains("-2147483648"));
    assert!(refusal(&bmp(-2, 2, 24, 0, &TWO_BY_TWO)).contains("-2 x 2"));
    assert!(refusal(&bmp(0, 2, 24, 0, &TWO_BY_TWO)).contains("0 x 2"));
    assert!(
        refusal(&bmp(8000, 8000, 24, 0, &TWO_BY_TWO))
            .contains("truncated: 70 bytes, expected at least 192000054")
    );
}

#[test]
fn every_truncation_is_refused_and_none_panics() {
    let whole = bmp(2, 2, 24, 0, &TWO_BY_TWO);
    for n_bytes in 2..whole.len() {
        assert!(refusal(&whole[..n_bytes]).contains("truncated"), "{n_bytes} bytes");
    }
}

#[test]
fn no_damaged_byte_panics() {
    let whole = bmp(2, 2, 24, 0, &TWO_BY_TWO);
    for at in 0..54 {
        for value in [0, 1, 12, 24, 64, 127, 128, 255] {
            let mut damaged = whole.clone();
            damaged[at] = value;
            if let Err(error) = decode_texture("wall.bmp", &damaged) {
                assert!(!error.to_string().contains('\n'));
            }
        }
    }
}
