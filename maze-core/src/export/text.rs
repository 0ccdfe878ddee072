//! Blocks -> text, as [`crate::import::text`] reads it.

use crate::layout::blocks::Blocks;

/// One character a block, without spaces at the ends of lines.
pub fn write(blocks: &Blocks) -> String {
    let mut text = String::with_capacity((blocks.width() + 1) * blocks.height());
    for y in (0..blocks.height()).rev() {
        let character = |x: usize| match blocks.ends() {
            _ if blocks.is_wall(x, y) => '#',
            [Some(start), _] if start == [x, y] => 'S',
            [_, Some(goal)] if goal == [x, y] => 'G',
            _ => ' ',
        };
        let line: String = (0..blocks.width()).map(character).collect();
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}
