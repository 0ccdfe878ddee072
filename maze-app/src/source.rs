//! Where a maze comes from: a file, a level, or a seed.

use crate::engine_kind::EngineKind;
use crate::failure::Failure;
use crate::levels::{self, Level, N_LEVELS};
use crate::loaded::Loaded;
use crate::platform::native::files::Input;
use crate::platform::native::maze_file::{self, Hints};
use crate::platform::native::sidecar::{
    Sidecar, TextSigns, parse_tone, parse_up_axis, radius_in_range, tone_name,
};
use crate::recipe::{self, RECIPE_ARGUMENTS, RecipeArguments};
use crate::screen::{Date, LevelCard};
use clap::Args;
use maze_core::import::picture::WallTone;
use maze_core::layout::{Algorithm, Recipe};
use maze_core::replay::MAX_NAME;
use maze_core::{AssembleOptions, BallKind, MAX_GRID_CELLS, Maze, Radius, UpAxis};
use std::path::{Path, PathBuf};

/// How to read a maze file.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ReadArguments {
    /// Ball radius in corridors, 0.02 to 0.49 [default: 0.35]
    #[arg(long, value_name = "R", value_parser = parse_radius)]
    ball_radius: Option<Radius>,
    /// Material of the ball: report (restitution 0.8, nothing slows it down) or steel (rolls, rebounds by 0.4, comes to rest)
    /// [default: the level's; steel to play, report elsewhere and with --engine published]
    #[arg(long, value_name = "NAME", value_parser = parse_ball)]
    ball: Option<BallKind>,
    /// Axis of an .obj that points out of the board [default: the one along which the file is flattest]
    #[arg(long, value_name = "AXIS", value_parser = parse_up_axis)]
    up: Option<UpAxis>,
    /// What signs of a .txt mean, such as `--text wall=#X --text free=.`; keys are wall, free, start and goal
    /// [default: found]
    #[arg(long, value_name = "KEY=SIGNS", value_parser = parse_signs)]
    text: Vec<(SignKey, String)>,
    /// Which pixels of a picture are walls, dark or light [default: found]
    #[arg(long, value_name = "TONE", value_parser = parse_tone)]
    walls: Option<WallTone>,
}

/// What signs of a text can be stated to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum SignKey {
    Wall,
    Free,
    Start,
    Goal,
}

impl SignKey {
    const ALL: [(Self, &'static str); 4] =
        [(Self::Wall, "wall"), (Self::Free, "free"), (Self::Start, "start"), (Self::Goal, "goal")];
}

fn parse_signs(text: &str) -> Result<(SignKey, String), String> {
    let known = text
        .split_once('=')
        .filter(|(_, signs)| !signs.is_empty() && !signs.contains(char::is_control))
        .and_then(|(key, signs)| {
            let (key, _) = SignKey::ALL.into_iter().find(|(_, name)| *name == key)?;
            Some((key, signs.to_owned()))
        });
    known.ok_or_else(|| "expected wall=SIGNS, free=SIGNS, start=SIGN or goal=SIGN".to_owned())
}

/// Which maze: a file, a level, or a seed.
#[derive(Args, Clone, Debug)]
pub(crate) struct MazeArguments {
    /// A maze (.obj, .svg, .txt, .png or .bmp); without one, a random maze
    #[arg(conflicts_with_all = RECIPE_ARGUMENTS, conflicts_with_all = ["random", "level"])]
    file: Option<PathBuf>,
    #[command(flatten)]
    read: ReadArguments,
    #[arg(long, value_name = "N", value_parser = levels::parse_level, help = levels::HELP)]
    #[arg(conflicts_with_all = RECIPE_ARGUMENTS, conflicts_with = "random")]
    level: Option<usize>,
    /// A random maze (what happens anyway without a FILE)
    #[arg(long)]
    random: bool,
    #[command(flatten)]
    recipe: RecipeArguments,
}

impl MazeArguments {
    /// Whether any of them was given.
    pub(crate) fn is_given(&self) -> bool {
        let has_maze = self.file.is_some() || self.level.is_some() || self.random || self.recipe.is_given();
        has_maze || !self.read.words().is_empty()
    }
}

/// Which maze, for a command that does not make any: a file or a level.
#[derive(Args, Clone, Debug)]
pub(crate) struct KnownMazeArguments {
    /// A maze (.obj, .svg, .txt, .png or .bmp)
    #[arg(required_unless_present = "level", conflicts_with = "level")]
    file: Option<PathBuf>,
    #[arg(long, value_name = "N", value_parser = levels::parse_level, help = levels::HELP)]
    level: Option<usize>,
    #[command(flatten)]
    read: ReadArguments,
}

impl ReadArguments {
    /// As on the command line.
    fn words(&self) -> Vec<String> {
        let radius = self.ball_radius.map(|radius| format!("--ball-radius={}", radius.units()));
        let ball = self.ball.map(|ball| format!("--ball={}", ball.name()));
        let up = self.up.map(|axis| format!("--up={}", axis.name()));
        let name = |key: SignKey| {
            SignKey::ALL.into_iter().find(|(known, _)| *known == key).map_or("", |(_, name)| name)
        };
        let signs = self.text.iter().map(|(key, signs)| format!("--text={}={signs}", name(*key)));
        let walls = self.walls.map(|tone| format!("--walls={}", tone_name(tone)));
        [radius, ball, up, walls].into_iter().flatten().chain(signs).collect()
    }

    /// The signs that flags state; of two statements the last one counts.
    fn signs(&self) -> TextSigns {
        let mut stated = TextSigns::default();
        for (key, signs) in &self.text {
            let key = match key {
                SignKey::Wall => &mut stated.wall,
                SignKey::Free => &mut stated.free,
                SignKey::Start => &mut stated.start,
                SignKey::Goal => &mut stated.goal,
            };
            *key = Some(signs.clone());
        }
        stated
    }

    /// Flags win over what stands beside the file.
    fn options(&self, sidecar: &Sidecar) -> AssembleOptions {
        AssembleOptions {
            up_axis: self.up.or(sidecar.up),
            ball_radius: self.ball_radius.or(sidecar.ball_radius),
            scale: sidecar.scale,
            start: sidecar.start,
            goal: sidecar.goal,
        }
    }

    /// Reads a maze file and the sidecar beside it; the file extension gives the kind.
    pub(crate) fn load(&self, path: &Path) -> Result<Loaded, Failure> {
        let sidecar = Sidecar::beside(path)?;
        let hints =
            Hints { signs: self.signs().or(&sidecar.text), wall: self.walls.or(sidecar.picture.wall) };
        maze_file::load(path, &self.options(&sidecar), &hints)
    }

    /// The maze of a recipe.
    pub(crate) fn generate(&self, recipe: &Recipe) -> Result<Maze, Failure> {
        let layout = recipe.layout().map_err(Failure::bad_input)?;
        // The axis that was given is that of a file, which a player may have left for a level.
        let options = AssembleOptions { up_axis: Some(UpAxis::Z), ..self.options(&Sidecar::default()) };
        layout.maze(&options).map_err(Failure::bad_input)
    }
}

/// What is played, and how to get the next maze of the same kind.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    read: ReadArguments,
    kind: Kind,
}

#[derive(Clone, Debug)]
enum Kind {
    File(PathBuf),
    Level { number: usize, level: Level },
    Random(Recipe),
    Daily(Date),
}

impl Kind {
    fn level(number: usize) -> Result<Self, Failure> {
        Ok(Self::Level { number, level: levels::level(number)? })
    }
}

impl Source {
    /// Chooses a seed where none was given.
    pub(crate) fn new(arguments: &MazeArguments) -> Result<Self, Failure> {
        let kind = match (&arguments.file, arguments.level) {
            (Some(path), _) => Kind::File(path.clone()),
            (None, Some(number)) => Kind::level(number)?,
            (None, None) => Kind::Random(arguments.recipe.recipe()),
        };
        Ok(Self { read: arguments.read.clone(), kind })
    }

    /// The file or the level.
    pub(crate) fn known(arguments: &KnownMazeArguments) -> Result<Self, Failure> {
        let kind = match &arguments.file {
            Some(path) => Kind::File(path.clone()),
            // One of the two is required.
            None => Kind::level(arguments.level.unwrap_or(1))?,
        };
        Ok(Self { read: arguments.read.clone(), kind })
    }

    pub(crate) fn level(number: usize) -> Result<Self, Failure> {
        Ok(Self { read: ReadArguments::default(), kind: Kind::level(number)? })
    }

    pub(crate) fn random(recipe: Recipe) -> Self {
        Self { read: ReadArguments::default(), kind: Kind::Random(recipe) }
    }

    /// The maze of a day.
    pub(crate) fn daily(date: Date) -> Self {
        Self { read: ReadArguments::default(), kind: Kind::Daily(date) }
    }

    /// Its number, of a level.
    pub(crate) fn level_number(&self) -> Option<usize> {
        match self.kind {
            Kind::Level { number, .. } => Some(number),
            _ => None,
        }
    }

    /// A picture of its plan, its name and its par, for the level grid.
    pub(crate) fn card(&self, maze: &Maze, tick_s: f64) -> LevelCard {
        let name = match &self.kind {
            Kind::Level { level, .. } => level.name.clone(),
            _ => self.title(),
        };
        let par_s = crate::ui::seconds(self.par_ticks().unwrap_or(0), tick_s);
        LevelCard { name, par_s, plan: crate::ui::plan_of(maze) }
    }

    /// A file, read as the last one was.
    pub(crate) fn of_file(&self, path: PathBuf) -> Self {
        Self { read: self.read.clone(), kind: Kind::File(path) }
    }

    /// A file, or else the random maze of a recipe.
    pub(crate) fn file_or_random(read: &ReadArguments, file: Option<PathBuf>, recipe: Recipe) -> Self {
        Self { read: read.clone(), kind: file.map_or(Kind::Random(recipe), Kind::File) }
    }

    /// The arguments, one a line, that give this maze again on the command line.
    pub(crate) fn words(&self) -> Result<String, Failure> {
        let mut words = self.read.words();
        match &self.kind {
            Kind::Random(recipe) => words.extend(recipe::words(recipe)),
            Kind::Daily(date) => words.extend(recipe::words(&date.recipe())),
            Kind::Level { number, .. } => words.push(format!("--level={number}")),
            Kind::File(path) => {
                let name = path.to_str().filter(|name| !name.contains('\n'));
                let name = name.ok_or_else(|| {
                    Failure::in_file(path, "a recording can only name a file in UTF-8 and on one line")
                })?;
                words.extend(["--".to_owned(), name.to_owned()]);
            }
        }
        Ok(words.join("\n"))
    }

    pub(crate) fn load(&self) -> Result<Maze, Failure> {
        self.load_for(EngineKind::Continuous, BallKind::Report)
    }

    /// With the ball for an engine; `usual` where neither a flag nor a level states one. The report's method is defined for the
    /// report's ball.
    pub(crate) fn load_for(&self, engine: EngineKind, usual: BallKind) -> Result<Maze, Failure> {
        let mut maze = self.load_and_tell()?.maze;
        let stated = match &self.kind {
            _ if engine == EngineKind::Published => BallKind::Report,
            Kind::Level { level, .. } => level.ball,
            Kind::Daily(_) => BallKind::Steel,
            Kind::File(_) | Kind::Random(_) => usual,
        };
        maze.ball = self.read.ball.unwrap_or(stated);
        Ok(maze)
    }

    /// The maze and what was found on the way to it.
    pub(crate) fn load_and_tell(&self) -> Result<Loaded, Failure> {
        match &self.kind {
            Kind::File(path) => self.read.load(path),
            Kind::Level { level, .. } => self.read.generate(&level.recipe).map(Loaded::from),
            Kind::Random(recipe) => self.read.generate(recipe).map(Loaded::from),
            Kind::Daily(date) => self.read.generate(&date.recipe()).map(Loaded::from),
        }
    }

    /// The files that it is read from, for [`crate::platform::native::files::expect_outputs`].
    pub(crate) fn inputs(&self) -> Vec<Input> {
        let beside = self.file().map(|maze| ("what stands beside the maze", maze.with_extension("toml")));
        self.file().map(|maze| ("the maze", maze.to_path_buf())).into_iter().chain(beside).collect()
    }

    /// Checks that a recording can name this maze.
    pub(crate) fn expect_recordable(&self) -> Result<(), Failure> {
        let n_bytes = self.words()?.len();
        if MAX_NAME < n_bytes {
            let reason = format!("{n_bytes} bytes to name this maze: a recording takes at most {MAX_NAME}");
            return Err(Failure::bad_input(reason));
        }
        if let Kind::Random(recipe) = &self.kind {
            let n_cells = recipe.width.saturating_mul(recipe.height);
            if MAX_GRID_CELLS < n_cells {
                // A recording is small, and must not ask for much.
                let reason =
                    format!("a random maze of {n_cells} cells: a recording takes at most {MAX_GRID_CELLS}");
                return Err(Failure::bad_input(reason));
            }
        }
        Ok(())
    }

    /// The file it comes from.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.kind {
            Kind::File(path) => Some(path),
            Kind::Level { .. } | Kind::Random(_) | Kind::Daily(_) => None,
        }
    }

    /// What an error calls it.
    pub(crate) fn name(&self) -> String {
        match &self.kind {
            Kind::File(path) => path.display().to_string(),
            Kind::Level { .. } | Kind::Random(_) | Kind::Daily(_) => self.title(),
        }
    }

    /// What the screen calls it.
    pub(crate) fn title(&self) -> String {
        match &self.kind {
            Kind::File(path) => path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            Kind::Level { number, level } => format!("Level {number}  {}", level.name),
            Kind::Daily(date) => format!("Daily maze {date}"),
            Kind::Random(Recipe { width, height, algorithm: Algorithm::Backtracker, seed, .. }) => {
                format!("{width}x{height}  seed {seed}")
            }
            Kind::Random(Recipe { width, height, algorithm, seed, .. }) => {
                format!("{width}x{height}  {algorithm}  seed {seed}")
            }
        }
    }

    /// The time to beat, where there is one.
    pub(crate) fn par_ticks(&self) -> Option<u64> {
        match &self.kind {
            Kind::Level { level, .. } => Some(level.par_ticks),
            Kind::File(_) | Kind::Random(_) | Kind::Daily(_) => None,
        }
    }

    /// What comes after this maze.
    pub(crate) fn onwards(&self) -> Onwards {
        match &self.kind {
            Kind::Random(_) => Onwards::NewMaze,
            Kind::Level { number, .. } if *number < N_LEVELS => Onwards::NextLevel,
            Kind::Level { .. } | Kind::File(_) | Kind::Daily(_) => Onwards::Nothing,
        }
    }

    /// Moves on to the random maze of a seed or to the next level; false when there is none.
    pub(crate) fn go_on(&mut self, seed: u64) -> Result<bool, Failure> {
        match &mut self.kind {
            Kind::File(_) | Kind::Daily(_) => Ok(false),
            Kind::Level { .. } => self.change_level(true),
            Kind::Random(recipe) => {
                recipe.seed = seed;
                Ok(true)
            }
        }
    }

    /// Moves to the next level or to the one before, to the first one from any other maze; false at either end.
    pub(crate) fn change_level(&mut self, forwards: bool) -> Result<bool, Failure> {
        let number = match (&self.kind, forwards) {
            (Kind::Level { number, .. }, true) => number + 1,
            (Kind::Level { number, .. }, false) => number - 1,
            (Kind::File(_) | Kind::Random(_) | Kind::Daily(_), _) => 1,
        };
        let exists = (1..=N_LEVELS).contains(&number);
        if exists {
            self.kind = Kind::level(number)?;
        }
        Ok(exists)
    }
}

/// What comes after a maze.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Onwards {
    #[default]
    Nothing,
    NewMaze,
    NextLevel,
}

fn parse_ball(text: &str) -> Result<BallKind, String> {
    text.parse().map_err(|error: maze_core::UnknownBall| error.to_string())
}

fn parse_radius(text: &str) -> Result<Radius, String> {
    radius_in_range(text.parse().unwrap_or(f64::NAN))
}
