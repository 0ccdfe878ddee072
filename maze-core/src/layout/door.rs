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

impl Side {
    /// `left`, `right`, `bottom` or `top`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Bottom => "bottom",
            Self::Top => "top",
        }
    }
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

/// No cell lies behind a door.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no cell {index} on the {side} side of a maze of {width}x{height} cells", index = .door.index, side = .door.side.name())]
pub struct NoSuchDoor {
    /// As asked for.
    pub door: Door,
    /// Cells along x.
    pub width: usize,
    /// Cells along y.
    pub height: usize,
}
