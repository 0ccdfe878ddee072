//! A recording of a run: what was played on what, the tilt of every tick, and the state it ended in.

use crate::maze::Maze;
use crate::physics::ball::Ball;
use crate::physics::gravity::Tilt;
use crate::physics::wall::Facing;
use nalgebra::Vector2;

/// First bytes of a recording.
const MAGIC: &[u8; 8] = b"MAZERUN\n";

/// Version of the format and of everything that decides the motion: raised when an old recording would end elsewhere.
pub const VERSION: u32 = 3;

/// Longest recording: ten hours of ticks of 0.03 s, 5 MB.
pub const MAX_TICKS: usize = 1_200_000;

/// Longest name of a source or an engine (bytes).
pub const MAX_NAME: usize = 4096;

/// A run that can be played again bit for bit. Four bytes a tick: ten minutes of ticks of 0.03 s are 80 kB.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// How to get the maze again, in the words of the program that recorded.
    pub source: String,
    /// [`maze_hash`] of the maze.
    pub maze_hash: u64,
    /// Which engine.
    pub engine: String,
    /// Radius (units), restitution, rolling factor, rolling resistance (units/s²), tick length (s).
    pub constants: [f64; 5],
    /// One a tick.
    pub tilts: Vec<Tilt>,
    /// [`state_hash`] of the ball after the last tick.
    pub final_hash: u64,
}

/// Why bytes are no recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReplayError {
    /// Something else.
    #[error("not a recording of a run: expected it to begin with MAZERUN")]
    NotRecording,
    /// Made by another version.
    #[error("a recording of version {found}: this program plays version {VERSION}")]
    Version {
        /// In the file.
        found: u32,
    },
    /// It ends too early.
    #[error("the recording is cut off after {n_bytes} bytes, while reading {what}")]
    CutOff {
        /// Length of the file.
        n_bytes: usize,
        /// What was expected there.
        what: &'static str,
    },
    /// It goes on after its end.
    #[error("{n_bytes} bytes after the recording's end")]
    TooLong {
        /// How many.
        n_bytes: usize,
    },
    /// A length or text that no recording has.
    #[error("the recording's {what} is damaged")]
    Damaged {
        /// Which part.
        what: &'static str,
    },
}

/// 64-bit FNV-1a (Fowler, Noll, Vo), byte by byte: to tell apart, not to protect.
fn fnv1a(words: impl IntoIterator<Item = u64>) -> u64 {
    let bytes = words.into_iter().flat_map(u64::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn bits(vector: Vector2<f64>) -> [u64; 2] {
    [vector.x.to_bits(), vector.y.to_bits()]
}

/// Tells mazes apart by all that a run depends on: planes, start and goal, to the bit.
pub fn maze_hash(maze: &Maze) -> u64 {
    let planes = Facing::ALL.into_iter().flat_map(|facing| maze.planes.planes(facing));
    let of_planes = planes.flat_map(|plane| {
        [plane.facing as u64, plane.offset.to_bits(), plane.start.to_bits(), plane.end.to_bits()]
    });
    fnv1a(of_planes.chain(bits(maze.start)).chain(bits(maze.goal)))
}

/// Tells states apart, to the bit.
pub fn state_hash(ball: Ball) -> u64 {
    fnv1a(bits(ball.position).into_iter().chain(bits(ball.velocity)))
}

impl Recording {
    /// As a file.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        for name in [&self.source, &self.engine] {
            bytes.extend((name.len() as u64).to_le_bytes());
            bytes.extend(name.as_bytes());
        }
        bytes.extend(self.maze_hash.to_le_bytes());
        bytes.extend(self.constants.into_iter().flat_map(f64::to_le_bytes));
        bytes.extend((self.tilts.len() as u64).to_le_bytes());
        for tilt in &self.tilts {
            bytes.extend(tilt.towards_x.to_le_bytes());
            bytes.extend(tilt.towards_y.to_le_bytes());
        }
        bytes.extend(self.final_hash.to_le_bytes());
        bytes
    }

    /// From a file.
    ///
    /// # Errors
    /// Bytes that are not a whole recording of this version.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ReplayError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(ReplayError::NotRecording)?;
        let mut reader = Reader { rest, n_bytes: bytes.len() };
        let found = u32::from_le_bytes(reader.take("the version")?);
        if found != VERSION {
            return Err(ReplayError::Version { found });
        }
        let recording = Self {
            source: reader.name("source")?,
            engine: reader.name("engine")?,
            maze_hash: u64::from_le_bytes(reader.take("the maze's hash")?),
            constants: [
                f64::from_le_bytes(reader.take("the ball's radius")?),
                f64::from_le_bytes(reader.take("the restitution")?),
                f64::from_le_bytes(reader.take("the rolling factor")?),
                f64::from_le_bytes(reader.take("the rolling resistance")?),
                f64::from_le_bytes(reader.take("the tick's length")?),
            ],
            tilts: reader.tilts()?,
            final_hash: u64::from_le_bytes(reader.take("the final state")?),
        };
        match reader.rest.len() {
            0 => Ok(recording),
            n_bytes => Err(ReplayError::TooLong { n_bytes }),
        }
    }
}

struct Reader<'a> {
    rest: &'a [u8],
    n_bytes: usize,
}

impl Reader<'_> {
    fn take<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], ReplayError> {
        let (taken, rest) =
            self.rest.split_first_chunk().ok_or(ReplayError::CutOff { n_bytes: self.n_bytes, what })?;
        self.rest = rest;
        Ok(*taken)
    }

    fn length(&mut self, what: &'static str, most: usize) -> Result<usize, ReplayError> {
        let length = usize::try_from(u64::from_le_bytes(self.take(what)?)).ok();
        length.filter(|length| *length <= most).ok_or(ReplayError::Damaged { what })
    }

    fn name(&mut self, what: &'static str) -> Result<String, ReplayError> {
        let length = self.length(what, MAX_NAME)?;
        let cut_off = ReplayError::CutOff { n_bytes: self.n_bytes, what };
        let (name, rest) = self.rest.split_at_checked(length).ok_or(cut_off)?;
        self.rest = rest;
        String::from_utf8(name.to_vec()).map_err(|_| ReplayError::Damaged { what })
    }

    fn tilts(&mut self) -> Result<Vec<Tilt>, ReplayError> {
        let n_ticks = self.length("ticks", MAX_TICKS)?;
        let mut tilt = |_| {
            let towards_x = i16::from_le_bytes(self.take("the ticks")?);
            Ok(Tilt { towards_x, towards_y: i16::from_le_bytes(self.take("the ticks")?) })
        };
        (0..n_ticks).map(&mut tilt).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn recording() -> Recording {
        Recording {
            source: "--seed 7".to_owned(),
            maze_hash: 0x1234_5678_9abc_def0,
            engine: "continuous".to_owned(),
            constants: [0.35, 0.8, 1.0, 0.0, 0.03],
            tilts: (0..20_000).map(|n| Tilt { towards_x: n, towards_y: -n }).collect(),
            final_hash: 42,
        }
    }

    #[test]
    fn a_recording_reads_back_and_ten_minutes_are_small() {
        let bytes = recording().to_bytes();
        assert_eq!(Recording::from_bytes(&bytes).unwrap(), recording());
        assert!(bytes.len() < 200_000, "{}", bytes.len());
    }

    #[test]
    fn a_cut_or_changed_file_is_refused_with_the_reason() {
        let bytes = Recording { tilts: vec![Tilt::LEVEL; 3], ..recording() }.to_bytes();
        for end in 0..bytes.len() {
            let error = Recording::from_bytes(&bytes[..end]).unwrap_err();
            let cut_off = matches!(error, ReplayError::CutOff { n_bytes, .. } if n_bytes == end);
            assert!(cut_off || end < MAGIC.len() && error == ReplayError::NotRecording, "{end}: {error}");
        }
        let longer = [&bytes[..], b"x"].concat();
        assert_eq!(Recording::from_bytes(&longer), Err(ReplayError::TooLong { n_bytes: 1 }));
        let mut other = bytes.clone();
        other[MAGIC.len()] = 9;
        assert_eq!(
            Recording::from_bytes(&other).unwrap_err().to_string(),
            "a recording of version 9: this program plays version 3"
        );
        let mut absurd = bytes;
        absurd[MAGIC.len() + 4 + 7] = 0xff;
        assert_eq!(Recording::from_bytes(&absurd), Err(ReplayError::Damaged { what: "source" }));
    }
}
