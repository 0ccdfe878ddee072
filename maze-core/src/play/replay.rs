//! A recording of a run: which maze and engine, the tilt of every tick, and the state it ended in.

use crate::maze::Maze;
use crate::physics::ball::{Ball, BallSpec, OutOfRange, Radius};
use crate::physics::engine::{Continuous, Engine, Published};
use crate::physics::gravity::{self, Tilt};
use crate::physics::wall::Facing;
use crate::play::rules::{Phase, Run};
use nalgebra::Vector2;
use std::sync::Arc;

/// First bytes of a recording.
const MAGIC: &[u8; 8] = b"MAZERUN\n";

/// Version of the format and of everything that decides the motion: raised when an old recording would end elsewhere.
pub const VERSION: u32 = 3;

/// Longest recording: ten hours of ticks of 0.03 s, 5 MB.
pub const MAX_TICKS: usize = 1_200_000;

/// Longest name of a source or an engine (bytes).
pub const MAX_NAME: usize = 4096;

/// The numbers of the ball and the tick that a recording keeps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Of the ball (units).
    pub radius: f64,
    /// Fraction of the normal speed that a bounce keeps.
    pub restitution: f64,
    /// Fraction of the projected gravity that accelerates the ball.
    pub rolling: f64,
    /// Rolling resistance (units/s²).
    pub resistance: f64,
    /// Length of a tick (s).
    pub tick_s: f64,
}

impl Constants {
    /// Those of an engine.
    pub fn of(engine: &(impl Engine + ?Sized)) -> Self {
        let BallSpec { radius, restitution, rolling, resistance } = *engine.spec();
        Self { radius: radius.units(), restitution, rolling, resistance, tick_s: engine.tick_s() }
    }

    /// The ball.
    ///
    /// # Errors
    /// A number that no ball has.
    pub fn spec(&self) -> Result<BallSpec, OutOfRange> {
        let Self { radius, restitution, rolling, resistance, .. } = *self;
        BallSpec { radius: Radius::new(radius)?, restitution, rolling, resistance }.checked()
    }

    /// In the order of the file.
    fn to_array(self) -> [f64; 5] {
        [self.radius, self.restitution, self.rolling, self.resistance, self.tick_s]
    }
}

/// A run that can be played again bit for bit. Four bytes a tick: ten minutes of ticks of 0.03 s are 80 kB.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// How to get the maze again, in the words of the program that recorded: maze-app writes the command-line arguments that name
    /// the maze, one a line, without quotes. [`Recording::verify`] does not read it; [`Recording::maze_hash`] tells whether a maze
    /// is the right one.
    pub source: String,
    /// [`maze_hash`] of the maze.
    pub maze_hash: u64,
    /// Name of the engine: `continuous` and `published` are known here.
    pub engine: String,
    /// Of the ball and the tick.
    pub constants: Constants,
    /// One a tick.
    pub tilts: Vec<Tilt>,
    /// [`state_hash`] of the ball after the last tick.
    pub final_hash: u64,
}

/// Why a recording is not reproduced.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// Another maze.
    #[error("recorded on another maze: its hash is {recorded:016x}, expected {found:016x}")]
    OtherMaze {
        /// In the recording.
        recorded: u64,
        /// Of the maze that was given.
        found: u64,
    },
    /// An engine that is not known here.
    #[error("recorded with an engine `{name}`: expected continuous or published")]
    UnknownEngine {
        /// In the recording.
        name: String,
    },
    /// Numbers that no ball or tick has.
    #[error("the recording's constants: {0}")]
    Constants(#[from] OutOfRange),
    /// The engine refuses a tick.
    #[error("tick {index}: {error}")]
    Tick {
        /// Which one, counted from 0.
        index: usize,
        /// Why.
        error: OutOfRange,
    },
    /// Another final state.
    #[error("the run ended in another state after {n_ticks} ticks")]
    OtherEnd {
        /// How many were played.
        n_ticks: usize,
        /// The run as it was played now.
        run: Run,
    },
}

/// Why bytes are no recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
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
        /// Which field.
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
    fnv1a(of_planes.chain(bits(maze.start())).chain(bits(maze.goal())))
}

/// Tells states apart, to the bit.
pub fn state_hash(ball: Ball) -> u64 {
    fnv1a(bits(ball.position).into_iter().chain(bits(ball.velocity)))
}

impl Recording {
    /// As a file. One with names of at most [`MAX_NAME`] bytes and at most [`MAX_TICKS`] ticks reads back.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(VERSION.to_le_bytes());
        for name in [&self.source, &self.engine] {
            bytes.extend((name.len() as u64).to_le_bytes());
            bytes.extend(name.as_bytes());
        }
        bytes.extend(self.maze_hash.to_le_bytes());
        bytes.extend(self.constants.to_array().into_iter().flat_map(f64::to_le_bytes));
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
            constants: Constants {
                radius: f64::from_le_bytes(reader.take("the ball's radius")?),
                restitution: f64::from_le_bytes(reader.take("the restitution")?),
                rolling: f64::from_le_bytes(reader.take("the rolling factor")?),
                resistance: f64::from_le_bytes(reader.take("the rolling resistance")?),
                tick_s: f64::from_le_bytes(reader.take("the tick's length")?),
            },
            tilts: reader.tilts()?,
            final_hash: u64::from_le_bytes(reader.take("the final state")?),
        };
        match reader.rest.len() {
            0 => Ok(recording),
            n_bytes => Err(ReplayError::TooLong { n_bytes }),
        }
    }
}

impl Recording {
    /// Plays the recording on a maze with the engine that it names, and compares the final state to the bit. Returns the run.
    ///
    /// ```
    /// use maze_core::layout::{Algorithm, Recipe};
    /// use maze_core::replay::{self, Constants, Recording};
    /// use maze_core::{Engine, Tilt, gravity};
    ///
    /// let maze = Recipe::new(6, 4, Algorithm::Wilson, 3).maze()?;
    /// let mut engine = maze.exact_engine(0.01)?;
    /// let tilts = vec![Tilt::degrees(4.0, -7.0); 500];
    /// for tilt in &tilts {
    ///     engine.tick(gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze()))?;
    /// }
    /// let recording = Recording {
    ///     source: "Wilson, 6 x 4 cells, seed 3".to_owned(),
    ///     maze_hash: replay::maze_hash(&maze),
    ///     engine: "continuous".to_owned(),
    ///     constants: Constants::of(&engine),
    ///     tilts,
    ///     final_hash: replay::state_hash(engine.ball()),
    /// };
    /// recording.verify(&maze)?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// The ball and the tick are the recording's; they are not compared with the maze's ball.
    ///
    /// # Errors
    /// Another maze, an engine that is not known here, constants that no ball or tick has, a tick that the engine refuses, another
    /// final state.
    pub fn verify(&self, maze: &Maze) -> Result<Run, VerifyError> {
        let (planes, spec, tick_s) =
            (Arc::clone(&maze.planes), self.constants.spec()?, self.constants.tick_s);
        let ball = Ball::at(maze.start());
        match self.engine.as_str() {
            "continuous" => self.verify_with(maze, &mut Continuous::new(planes, spec, ball, tick_s)?),
            "published" => self.verify_with(maze, &mut Published::new(planes, spec, ball, tick_s)?),
            _ => Err(VerifyError::UnknownEngine { name: self.engine.clone() }),
        }
    }

    /// [`Recording::verify`] with an engine of your own, whose ball is at rest at the maze's start. A ball at the goal stays where it
    /// is, whatever the tilts that follow.
    ///
    /// # Errors
    /// Another maze, a tick that the engine refuses, another final state.
    pub fn verify_with(&self, maze: &Maze, engine: &mut dyn Engine) -> Result<Run, VerifyError> {
        let (recorded, found) = (self.maze_hash, maze_hash(maze));
        if recorded != found {
            return Err(VerifyError::OtherMaze { recorded, found });
        }
        let mut run = Run::new(maze);
        let mut n_ticks = 0;
        for (index, tilt) in self.tilts.iter().enumerate() {
            if run.phase() == Phase::Finished {
                break;
            }
            let from = engine.ball().position;
            let acceleration = gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze());
            let tick = engine.tick(acceleration).map_err(|error| VerifyError::Tick { index, error })?;
            run.observe(*tilt, [from, engine.ball().position], &tick).for_each(drop);
            n_ticks += 1;
        }
        if state_hash(engine.ball()) == self.final_hash {
            Ok(run)
        } else {
            Err(VerifyError::OtherEnd { n_ticks, run })
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
            constants: Constants {
                radius: 0.35,
                restitution: 0.8,
                rolling: 1.0,
                resistance: 0.0,
                tick_s: 0.03,
            },
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

    #[test]
    fn a_recording_of_any_tick_length_verifies_and_a_changed_one_does_not() {
        let maze = crate::layout::Recipe::new(5, 4, crate::layout::Algorithm::Wilson, 8).maze().unwrap();
        let tilts: Vec<Tilt> = (0..400).map(|n| Tilt::degrees(f64::from(n % 50) / 4.0, -9.0)).collect();
        let play = |engine: &mut dyn Engine, name: &str| {
            for tilt in &tilts {
                engine.tick(gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze())).unwrap();
            }
            Recording {
                maze_hash: maze_hash(&maze),
                engine: name.to_owned(),
                constants: Constants::of(engine),
                tilts: tilts.clone(),
                final_hash: state_hash(engine.ball()),
                ..recording()
            }
        };
        for tick_s in [0.03, 0.001, 0.0123] {
            let exact = play(&mut maze.exact_engine(tick_s).unwrap(), "continuous");
            let published = play(&mut maze.published_engine(tick_s).unwrap(), "published");
            for recording in [&exact, &published] {
                assert_eq!(recording.verify(&maze).unwrap().n_ticks(), 400);
            }
            assert!(matches!(
                Recording { engine: "published".to_owned(), ..exact.clone() }.verify(&maze),
                Err(VerifyError::OtherEnd { n_ticks: 400, .. })
            ));
            let mut other = exact.clone();
            other.tilts[200] = Tilt::LEVEL;
            assert!(matches!(other.verify(&maze), Err(VerifyError::OtherEnd { .. })));
        }
        // Tilts after the goal are not played.
        let mut autopilot = crate::Autopilot::new(&maze, 0.17).unwrap();
        let (mut engine, mut run) = (maze.exact_engine(0.03).unwrap(), Run::new(&maze));
        let mut finished = Recording { tilts: Vec::new(), ..play(&mut engine.clone(), "continuous") };
        while run.phase() != Phase::Finished {
            let (tilt, from) = (autopilot.tilt(engine.ball()), engine.ball().position);
            let tick =
                engine.tick(gravity::project(gravity::WORLD_GRAVITY, &tilt.world_from_maze())).unwrap();
            run.observe(tilt, [from, engine.ball().position], &tick).for_each(drop);
            finished.tilts.push(tilt);
        }
        finished.final_hash = state_hash(engine.ball());
        let n_played = finished.tilts.len();
        finished.tilts.extend(vec![Tilt::LEVEL; 1000]);
        assert_eq!(finished.verify(&maze).unwrap().phase(), Phase::Finished);
        finished.final_hash ^= 1;
        assert_eq!(finished.verify(&maze), Err(VerifyError::OtherEnd { n_ticks: n_played, run }));
        let good = play(&mut maze.exact_engine(0.03).unwrap(), "continuous");
        let message = |recording: Recording| recording.verify(&maze).unwrap_err().to_string();
        let unknown = Recording { engine: "pinball".to_owned(), ..good.clone() };
        assert_eq!(message(unknown), "recorded with an engine `pinball`: expected continuous or published");
        assert!(message(Recording { maze_hash: 1, ..good.clone() }).starts_with("recorded on another maze"));
        let mut bad = good;
        bad.constants.tick_s = f64::NAN;
        assert_eq!(
            message(bad),
            "the recording's constants: the tick's length: expected seconds greater than 0, at most 1000"
        );
    }
}
