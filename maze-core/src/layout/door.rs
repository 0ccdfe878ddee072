//! Where the outer wall of a layout is open.

/// A side of the board.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// x = 0.
    Left,
    /// The largest x.
    Right,
    /// y = 0.
    Bottom,
    /// The largest y.
    Top,
}

/// An opening of the outer wall, as wide as a cell. Of two, one is the start and the other the goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Door {
    /// In which wall.
    pub side: Side,
    /// Of the cell behind it: its y on the left and right side, its x at the bottom and top.
    pub index: usize,
}

impl Door {
    /// The cell (x, y) behind the door in a layout of that size; `None` when there is none.
    pub fn cell(self, width: usize, height: usize) -> Option<(usize, usize)> {
        let (x, y) = match self.side {
            Side::Left => (0, self.index),
            Side::Right => (width.checked_sub(1)?, self.index),
            Side::Bottom => (self.index, 0),
            Side::Top => (self.index, height.checked_sub(1)?),
        };
        (x < width && y < height).then_some((x, y))
    }
}
