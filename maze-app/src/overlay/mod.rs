//! The method on screen: the game's state as lines and patches in the maze, and as panels of text beside it.

mod pen;
mod table;

use crate::numbers::to_f32;
use crate::numbers::to_points;
use crate::session::{Pose, Session};
use maze_core::trace::{self, GroupVisit, SearchTrace};
use maze_core::{Facing, Hit, Path, Plane, SweepQuery, contact, gravity};
use maze_render::Scene;
use nalgebra::{Point3, Vector2, Vector3};
use pen::Pen;

/// sRGB.
pub(crate) type Colour = [u8; 3];

pub(crate) const INK: Colour = [245, 238, 226];
pub(crate) const QUIET: Colour = [165, 155, 140];
pub(crate) const GOLD: Colour = [255, 205, 96];
const GRAVITY: Colour = [90, 240, 90];
const VELOCITY: Colour = [255, 150, 40];
const AFTER: Colour = [90, 220, 255];
const PENETRATION: Colour = [255, 60, 80];

/// Rays are as long as this many seconds of the motion, or of an acceleration from rest times a second.
const RAY_S: f64 = 0.5;

/// Speeds (units/s) and accelerations (units/s²) below this have no ray.
const LEAST_RAY: f64 = 1.0e-3;

/// Most planes that are coloured by their facing; of more, those around the middle of the view.
const MAX_COLOURED: usize = 4000;

/// How much nearer to the middle of the view coloured planes have to lie, as long as there are too many.
const NEARER: f64 = 0.7;

/// Reach of the clearance layer, in radii of the ball from its centre.
const REACH_RADII: f64 = 3.0;

/// One thing to be seen of the method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layer {
    /// Projected gravity and velocity, and nothing of the maze.
    Gravity,
    /// Walls coloured by facing.
    Planes,
    /// What the search probes at.
    Search,
    /// The last contact.
    Contact,
    /// Where the ball moves, and how fast.
    Velocity,
    /// The nearest plane, and all within reach.
    Clearance,
}

impl Layer {
    /// In the order of their keys, from 1.
    pub(crate) const ALL: [Self; 6] =
        [Self::Gravity, Self::Planes, Self::Search, Self::Contact, Self::Velocity, Self::Clearance];

    /// As on the command line.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::Gravity => "gravity",
            Self::Planes => "planes",
            Self::Search => "search",
            Self::Contact => "contact",
            Self::Velocity => "velocity",
            Self::Clearance => "clearance",
        }
    }
}

/// Those that are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Layers([bool; Layer::ALL.len()]);

impl Layers {
    pub(crate) fn has(self, layer: Layer) -> bool {
        self.0[layer as usize]
    }

    pub(crate) fn toggle(&mut self, layer: Layer) {
        self.0[layer as usize] = !self.has(layer);
    }

    /// From names with commas between them.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut layers = Self::default();
        for word in text.split(',').map(str::trim) {
            let known = Layer::ALL.into_iter().find(|layer| layer.name() == word);
            let Some(layer) = known else {
                let names = Layer::ALL.map(Layer::name).join(", ");
                return Err(format!("no overlay is named '{word}': expected any of {names}"));
            };
            layers.0[layer as usize] = true;
        }
        Ok(layers)
    }
}

/// Words of one colour.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) text: String,
    pub(crate) colour: Colour,
}

pub(crate) fn span(colour: Colour, text: impl Into<String>) -> Span {
    Span { text: text.into(), colour }
}

/// A heading and lines of letters of even width.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Panel {
    pub(crate) heading: String,
    pub(crate) lines: Vec<Vec<Span>>,
}

/// Words at a place in the picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tag {
    /// Fraction of the picture's width and height, from the upper left corner.
    pub(crate) at: [f32; 2],
    pub(crate) words: Span,
}

/// What is written beside and over the maze.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Notes {
    pub(crate) panels: Vec<Panel>,
    pub(crate) tags: Vec<Tag>,
}

/// Adds the layers' lines and patches to a scene of the game, `size` pixels large, and returns the text to write.
pub(crate) fn add(layers: Layers, game: &Session, scene: &mut Scene, size: [u32; 2]) -> Notes {
    if layers == Layers::default() {
        return Notes::default();
    }
    let mut drawing = Drawing::new(game, scene, size);
    for layer in Layer::ALL.into_iter().filter(|layer| layers.has(*layer)) {
        match layer {
            Layer::Gravity => drawing.gravity(),
            Layer::Planes => drawing.planes(),
            Layer::Search => drawing.search(),
            Layer::Contact => drawing.contact(),
            Layer::Velocity => drawing.velocity(),
            Layer::Clearance => drawing.clearance(),
        }
    }
    let Drawing { pen, notes, .. } = drawing;
    scene.shows_maze = !layers.has(Layer::Gravity);
    scene.lines.extend(pen.lines);
    scene.patches.extend(pen.patches);
    notes
}

/// Rings around the ball, the start and the goal that stand out from every floor: black with white inside.
pub(crate) fn mark(session: &Session, pose: &Pose, scene: &mut Scene) {
    let maze = session.maze();
    let radius = maze.ball_radius.units();
    let rings = [
        (pose.position(), 1.25 * radius),
        (maze.start(), maze.goal_radius()),
        (maze.goal(), maze.goal_radius()),
        (maze.goal(), 0.6 * maze.goal_radius()),
    ];
    let mut pen = Pen::new(Point3::origin(), maze.wall_height);
    for (middle, radius) in rings {
        for (width, colour) in [(7.0, [0, 0, 0]), (3.0, [255, 255, 255])] {
            // As high as the ball, so that no wall hides it.
            pen.ring(middle.push(maze.wall_height), radius, width, colour);
        }
    }
    scene.lines.extend(pen.lines);
}

/// The colours of the report.
fn colour_of(facing: Facing) -> Colour {
    match facing {
        Facing::PlusX => [255, 70, 60],
        Facing::MinusX => [70, 225, 80],
        Facing::PlusY => [60, 225, 235],
        Facing::MinusY => [80, 120, 255],
    }
}

struct Drawing<'a> {
    game: &'a Session,
    scene: &'a Scene,
    size: [u32; 2],
    /// The ball's centre as drawn, which is up to a tick behind the engine's.
    centre: Vector2<f64>,
    radius: f64,
    /// In the plane of the maze (units/s²), under the tilt that is drawn.
    acceleration: Vector2<f64>,
    velocity: Vector2<f64>,
    pen: Pen,
    notes: Notes,
}

impl<'a> Drawing<'a> {
    fn new(game: &'a Session, scene: &'a Scene, size: [u32; 2]) -> Self {
        let world_from_maze = scene.world_from_maze;
        let eye = world_from_maze.inverse_transform_point(&scene.camera.eye());
        let [x, y, _] = scene.ball.position.map(f64::from);
        Self {
            game,
            scene,
            size,
            centre: Vector2::new(x, y),
            radius: game.maze().ball_radius.units(),
            acceleration: gravity::project(gravity::WORLD_GRAVITY, &world_from_maze.cast()),
            velocity: game.ball().velocity,
            pen: Pen::new(eye.cast(), game.maze().wall_height),
            notes: Notes::default(),
        }
    }

    /// A point of the floor's plane at the height of the ball's centre.
    fn at_centre(&self, point: Vector2<f64>) -> Vector3<f64> {
        point.push(self.radius)
    }

    fn panel(&mut self, heading: &str, lines: Vec<Vec<Span>>) {
        self.notes.panels.push(Panel { heading: heading.to_owned(), lines });
    }

    /// Words at a point of the maze.
    fn tag(&mut self, point: Vector3<f64>, words: Span) {
        let world = self.scene.world_from_maze * Point3::from(point.map(to_f32));
        let [width, height] = self.size.map(|side| side.max(1));
        if let Some([x, y]) = self.scene.camera.project([width, height], world.coords.into()) {
            let at = [x / to_points(width, 1.0), y / to_points(height, 1.0)];
            self.notes.tags.push(Tag { at, words });
        }
    }

    fn ray(&mut self, vector: Vector2<f64>, colour: Colour) {
        if LEAST_RAY < vector.norm() {
            let from = self.at_centre(self.centre);
            self.pen.arrow(from, (vector * RAY_S).push(0.0), 4.0, colour);
        }
    }

    fn gravity(&mut self) {
        self.pen.board(&self.game.maze().bounds);
        let acceleration = self.acceleration;
        self.ray(acceleration, GRAVITY);
        self.ray(self.velocity, VELOCITY);
        // Gravity itself, and its normal component, which the floor takes: together they make the projection plain.
        let down = self.scene.world_from_maze.inverse() * Vector3::new(0.0, 0.0, to_f32(-RAY_S));
        let whole = down.cast::<f64>() * gravity::WORLD_GRAVITY.norm();
        let from = self.at_centre(self.centre);
        if LEAST_RAY < acceleration.norm() {
            self.pen.dashed(from + whole, from + (acceleration * RAY_S).push(0.0), 1.5, QUIET);
        }
        self.pen.arrow(from, whole, 2.0, QUIET);
        let text = |name: &str, vector: Vector2<f64>, unit: &str| format!("{name} {} {unit}", signed(vector));
        let lines = vec![
            vec![span(QUIET, "gravity       9.81 units/s² down")],
            vec![span(GRAVITY, text("in the plane ", acceleration, "units/s²"))],
            vec![span(VELOCITY, text("velocity     ", self.velocity, "units/s"))],
        ];
        self.panel("gravity in the maze's plane", lines);
    }

    fn planes(&mut self) {
        let planes = &self.game.maze().planes;
        let mut near: Vec<Plane> = if planes.len() <= MAX_COLOURED {
            Facing::ALL.into_iter().flat_map(|facing| planes.planes(facing)).collect()
        } else {
            let target = Point3::from(self.scene.camera.target);
            let middle = self.scene.world_from_maze.inverse_transform_point(&target).coords.xy().cast();
            let mut reach = self.game.maze().bounds.size().norm();
            loop {
                let near: Vec<Plane> = planes.planes_within(middle, reach).take(MAX_COLOURED + 1).collect();
                if near.len() <= MAX_COLOURED {
                    break near;
                }
                reach *= NEARER;
            }
        };
        let n_near = near.len();
        for plane in near.drain(..) {
            self.pen.face(&plane, 2.5, 120, colour_of(plane.facing));
        }
        let mut lines: Vec<Vec<Span>> = Facing::ALL
            .map(|facing| {
                let (n_planes, n_rows) = (planes.n_planes(facing), planes.n_rows(facing));
                let text = format!("{}  {n_planes:>5} planes in {n_rows} rows", facing.name());
                vec![span(colour_of(facing), text)]
            })
            .into();
        if n_near < planes.len() {
            lines.push(vec![span(QUIET, format!("the nearest {n_near} are coloured"))]);
        }
        self.panel("planes, by outward normal", lines);
    }

    /// The search that the engine's state would begin its next tick with.
    fn search(&mut self) {
        let (planes, tick_s) = (&self.game.maze().planes, self.game.tick_s());
        let ball = self.game.ball();
        let path = Path { position: ball.position, velocity: ball.velocity, acceleration: self.acceleration };
        let Ok(query) = SweepQuery::new(path, self.radius, tick_s) else { return };
        let trace = trace::search(planes, &query);
        self.search_in_maze(&trace, &path);
        // What there is to see: a plane that was tested, a row in reach, or else the first group.
        let groups = &trace.groups;
        let finds = |group: &&GroupVisit| group.rows.iter().any(|row| !row.planes.is_empty());
        let group = groups.iter().find(finds);
        let group = group.or_else(|| groups.iter().find(|group| !group.rows.is_empty())).or(groups.first());
        let facings: Vec<&str> = groups.iter().map(|group| group.facing.name()).collect();
        let mut lines = vec![vec![span(
            QUIET,
            match facings.as_slice() {
                [] => "the ball rests: no group is searched".to_owned(),
                _ => format!("groups searched: {}", facings.join(" ")),
            },
        )]];
        if let Some(group) = group {
            lines.extend(table::lines(planes, group, colour_of(group.facing)));
        }
        lines.push(vec![match trace.impact {
            Some(impact) => span(GOLD, format!("touches after {:.2} ms", 1.0e3 * impact.time_s)),
            None => span(QUIET, format!("nothing touched within {:.0} ms", 1.0e3 * tick_s)),
        }]);
        self.panel("search of the next tick", lines);
    }

    fn search_in_maze(&mut self, trace: &SearchTrace, path: &Path) {
        for group in &trace.groups {
            let colour = colour_of(group.facing);
            for row in &group.rows {
                // The row, the range of it that is searched, and what that holds.
                let planes = self.game.maze().planes.planes(group.facing);
                for plane in planes.filter(|plane| plane.offset == row.offset) {
                    self.pen.face(&plane, 2.5, 90, colour);
                }
                let window = row.window.map(|along| group.facing.point(row.offset, along));
                self.pen.pane(window, 60, colour);
                for plane in &row.planes {
                    self.pen.face(plane, 5.0, 170, GOLD);
                }
            }
        }
        let end = path.at(self.game.tick_s());
        let (from, to) = (self.at_centre(path.position), self.at_centre(end));
        self.pen.line(from, to, 4.0, VELOCITY);
        self.pen.ring(to, self.radius, 2.0, VELOCITY);
        if let Some(impact) = &trace.impact {
            self.pen.dot(self.at_centre(impact.point(path)), 0.25 * self.radius, GOLD);
        }
    }

    fn contact(&mut self) {
        let Some(hit) = self.game.last_hit().copied() else {
            return self.panel("last contact", vec![vec![span(QUIET, "none yet")]]);
        };
        self.contact_in_maze(&hit);
        let met = if hit.penetration == 0.0 { "0: walls are met exactly" } else { "pushed out again" };
        let depth = match hit.penetration {
            0.0 => met.to_owned(),
            depth => format!("{depth:.4} units, {met}"),
        };
        let lines = vec![
            vec![span(GOLD, format!("closest  {}", signed(hit.point)))],
            vec![span(INK, format!("normal   {}", signed(hit.normal)))],
            vec![span(PENETRATION, format!("depth    {depth}"))],
            vec![span(VELOCITY, format!("before   {}", motion(hit.before.velocity)))],
            vec![span(AFTER, format!("after    {}", motion(hit.after.velocity)))],
        ];
        self.panel("last contact", lines);
    }

    fn contact_in_maze(&mut self, hit: &Hit) {
        let point = self.at_centre(hit.point);
        let along = Vector2::new(-hit.normal.y, hit.normal.x) * (1.6 * self.radius);
        self.pen.line(point - along.push(0.0), point + along.push(0.0), 3.0, GOLD);
        let [before, after] = [hit.before, hit.after].map(|ball| self.at_centre(ball.position));
        if 0.0 < hit.penetration {
            self.pen.ring(before, self.radius, 2.0, PENETRATION);
            // How deep the ball was in the wall: what it was pushed out by.
            let deepest = point - (hit.normal * hit.penetration).push(0.0);
            self.pen.line(point, deepest, 5.0, PENETRATION);
        }
        self.pen.ring(after, self.radius, 2.0, INK);
        self.pen.line(after, point, 1.5, INK);
        let [incoming, outgoing] = [hit.before, hit.after].map(|ball| (ball.velocity * RAY_S).push(0.0));
        if LEAST_RAY < hit.before.velocity.norm() {
            self.pen.arrow(before - incoming, incoming, 3.5, VELOCITY);
        }
        if LEAST_RAY < hit.after.velocity.norm() {
            self.pen.arrow(after, outgoing, 3.5, AFTER);
        }
        self.pen.dot(point, 0.14 * self.radius, GOLD);
    }

    fn velocity(&mut self) {
        self.ray(self.velocity, VELOCITY);
        let tip = self.at_centre(self.centre + self.velocity * RAY_S);
        self.tag(tip, span(VELOCITY, format!("{:.2} units/s", self.velocity.norm())));
        self.panel("velocity", vec![vec![span(VELOCITY, motion(self.velocity))]]);
    }

    fn clearance(&mut self) {
        let planes = &self.game.maze().planes;
        let reach = REACH_RADII * self.radius;
        let within: Vec<Plane> = planes.planes_within(self.centre, reach).collect();
        for plane in &within {
            self.pen.face(plane, 2.5, 90, colour_of(plane.facing));
        }
        self.pen.ring(self.at_centre(self.centre), reach, 1.5, QUIET);
        let mut lines = vec![vec![span(INK, format!("{} planes within {reach:.2} units", within.len()))]];
        if let Some(nearest) = planes.clearance(self.centre) {
            self.pen.face(&nearest.plane, 4.0, 150, GOLD);
            let closest = contact::closest_point(self.centre, &nearest.plane);
            let (from, to) = (self.at_centre(self.centre), self.at_centre(closest));
            self.pen.line(from, to, 3.0, GOLD);
            self.pen.dot(to, 0.14 * self.radius, GOLD);
            let free = nearest.distance - self.radius;
            self.tag(to, span(GOLD, format!("{:.3}", nearest.distance)));
            lines.push(vec![span(GOLD, format!("nearest faces {}", nearest.plane.facing.name()))]);
            lines.push(vec![span(GOLD, format!("{:.4} from the centre", nearest.distance))]);
            lines.push(vec![span(GOLD, format!("{free:.4} from the ball"))]);
        }
        self.panel("clearance", lines);
    }
}

/// Both coordinates.
fn signed(vector: Vector2<f64>) -> String {
    format!("({:>6.2}, {:>6.2})", vector.x, vector.y)
}

fn motion(velocity: Vector2<f64>) -> String {
    format!("{}  {:.2} units/s", signed(velocity), velocity.norm())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine_kind::EngineKind;
    use maze_core::{AssembleOptions, Maze, Tilt, extrude, layout};
    use maze_render::Camera;

    #[test]
    fn layers_are_read_by_name_and_toggled() {
        let mut layers = Layers::parse("gravity, contact").unwrap();
        let shown = |layers: Layers| Layer::ALL.map(|layer| layers.has(layer));
        assert_eq!(shown(layers), [true, false, false, true, false, false]);
        layers.toggle(Layer::Gravity);
        layers.toggle(Layer::Clearance);
        assert_eq!(layers, Layers::parse("clearance,contact").unwrap());
        let error = Layers::parse("gravity,tensors").unwrap_err();
        let known = "gravity, planes, search, contact, velocity, clearance";
        assert_eq!(error, format!("no overlay is named 'tensors': expected any of {known}"));
        assert!(Layers::parse("").is_err());
    }

    fn game(engine: EngineKind) -> Session {
        let mesh = extrude::extrude(&layout::recursive_backtracker(6, 5, 11).unwrap());
        let mut game =
            Session::new(Maze::from_polygons(&mesh, &AssembleOptions::default()).unwrap(), engine).unwrap();
        for _ in 0..200 {
            game.tick(Tilt::from_half_tangents(0.06, 0.05)).unwrap();
        }
        game
    }

    fn shown(game: &Session, layers: &str) -> (Scene, Notes) {
        let camera = Camera { target: [0.0; 3], distance: 20.0, pitch_rad: maze_render::PITCH_RAD };
        let mut scene = game.scene(&game.pose(1.0, None), camera);
        let layers = if layers.is_empty() { Layers::default() } else { Layers::parse(layers).unwrap() };
        let notes = add(layers, game, &mut scene, [640, 360]);
        (scene, notes)
    }

    #[test]
    fn nothing_is_added_unless_asked_for_and_gravity_alone_hides_the_maze() {
        let game = game(EngineKind::Continuous);
        let (plain, notes) = shown(&game, "");
        assert!(plain.lines.is_empty() && plain.patches.is_empty() && notes == Notes::default());
        for layer in Layer::ALL {
            let (scene, notes) = shown(&game, layer.name());
            assert_eq!(scene.shows_maze, layer != Layer::Gravity);
            assert_eq!(notes.panels.len(), 1, "{layer:?}");
        }
    }

    #[test]
    fn each_plane_has_an_edge_in_its_facings_colour() {
        let game = game(EngineKind::Continuous);
        let (scene, _) = shown(&game, "planes");
        for facing in Facing::ALL {
            let is_facing = |line: &&maze_render::Line| line.colour[..3] == colour_of(facing);
            assert_eq!(scene.lines.iter().filter(is_facing).count(), game.maze().planes.n_planes(facing));
        }
    }

    #[test]
    fn the_published_engines_contact_has_a_depth_and_the_exact_ones_has_none() {
        for (engine, is_deep) in [(EngineKind::Published, true), (EngineKind::Continuous, false)] {
            let game = game(engine);
            assert_eq!(0.0 < game.last_hit().unwrap().penetration, is_deep);
            let (_, notes) = shown(&game, "contact");
            let depth = &notes.panels[0].lines[2][0].text;
            assert_eq!(depth.contains("pushed out again"), is_deep, "{depth}");
        }
    }
}
