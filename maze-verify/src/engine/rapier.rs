//! rapier3d as a [`maze_core::Engine`], held in the plane: gravity is projected for it, as for our engines.

use crate::board::Board;
use maze_core::{Ball, BallSpec, Engine, Observer, OutOfRange, Tick};
use nalgebra::Vector2;
use rapier3d::prelude::*;

/// What rapier is given as walls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walls {
    /// A cuboid for each rectangle of the board.
    Cuboids,
    /// The same cuboids as one compound shape: what a large maze is best given as.
    Compound,
    /// One triangle mesh, with the contacts at its internal edges corrected ([`TriMeshFlags::FIX_INTERNAL_EDGES`]).
    TriangleMesh,
}

/// A ball among fixed walls, held in the plane: what rapier makes of the same scene.
///
/// rapier computes in f32. The ball neither turns nor sleeps, and nothing rubs, as in maze-core; rapier's restitution is
/// the mean of both colliders', so both get the ball's; its bound on the speed (400 units/s) is lifted.
pub struct RapierEngine {
    world: PhysicsWorld,
    body: RigidBodyHandle,
    collider: ColliderHandle,
    spec: BallSpec,
    tick_s: f64,
    pair_events: Vec<BroadPhasePairEvent>,
}

/// The group of colliders that balls are in, and walls are in all.
const BALLS: Group = Group::GROUP_2;

/// Half the height of walls (units): any height that the ball's centre stays well inside of.
const HALF_HEIGHT: f32 = 0.5;

impl RapierEngine {
    /// `tick_s` is rapier's step (s).
    ///
    /// # Errors
    /// A position or velocity that is not finite; walls that rapier makes no mesh of.
    pub fn new(
        board: &Board,
        walls: Walls,
        spec: BallSpec,
        ball: Ball,
        tick_s: f64,
    ) -> Result<Self, OutOfRange> {
        let (ball, spec) = (ball.checked()?, spec.checked()?);
        let restitution = to_f32(spec.restitution);
        let mut world = world(tick_s);
        for wall in colliders(board, walls, HALF_HEIGHT, 0.0)? {
            world.insert_collider(wall.restitution(restitution).friction(0.0), None);
        }
        let (body, shape) = ball_builders(&spec, ball);
        let (body, collider) = world.insert(body, shape);
        Ok(Self { world, body, collider, spec, tick_s, pair_events: Vec::new() })
    }

    /// How far off a wall its contacts begin (units), rapier's margin for fast bodies; 0.02 as it comes. At a corner such an
    /// early contact has the direction of a touch that has not happened yet.
    pub fn set_prediction_distance(&mut self, units: f64) {
        self.world.integration_parameters.normalized_prediction_distance = to_f32(units);
    }

    /// Whether fast balls are stopped at the first fixed wall in their way, as rapier does unless told otherwise. Without it
    /// they pass through.
    pub fn set_ccd(&mut self, is_on: bool) {
        let usual = IntegrationParameters::default().max_ccd_substeps;
        self.world.integration_parameters.max_ccd_substeps = if is_on { usual } else { 0 };
    }

    /// rapier's step under an acceleration (units/s²) and nothing else: [`Engine::tick`] without reading its events.
    /// Needs a finite acceleration.
    pub fn step(&mut self, acceleration: Vector2<f64>) {
        if self.spec.resistance == 0.0 {
            return self.step_freely(acceleration);
        }
        // rapier knows no rolling resistance: our engines' rule, between its steps.
        let velocity = self.ball().velocity;
        if self.spec.holds(velocity, acceleration * self.spec.rolling, self.tick_s) {
            self.world.bodies[self.body].set_linvel(in_plane(Vector2::zeros()), true);
            return self.step_freely(Vector2::zeros());
        }
        self.step_freely(acceleration);
        let velocity = self.ball().velocity;
        let slowed = in_plane(self.spec.slowed(velocity, self.tick_s));
        self.world.bodies[self.body].set_linvel(slowed, true);
    }

    fn step_freely(&mut self, acceleration: Vector2<f64>) {
        self.world.gravity = in_plane(acceleration * self.spec.rolling);
        self.world.step();
    }

    /// Adds balls of the same kind, which meet the walls but neither one another nor the first ball: [`Self::step`] moves
    /// them all.
    ///
    /// # Errors
    /// A position or velocity that is not finite.
    pub fn add_balls(&mut self, balls: impl Iterator<Item = Ball>) -> Result<(), OutOfRange> {
        for ball in balls {
            let (body, collider) = ball_builders(&self.spec, ball.checked()?);
            self.world.insert(body, collider);
        }
        Ok(())
    }

    /// Puts the ball's collider somewhere and updates rapier's broad phase alone; how many pairs of boxes came or went.
    pub fn update_broad_phase(&mut self, centre: Vector2<f64>) -> usize {
        let Self { world, pair_events, .. } = self;
        if let Some(collider) = world.colliders.get_mut(self.collider) {
            collider.set_translation(in_plane(centre));
        }
        pair_events.clear();
        let (parameters, moved) = (&world.integration_parameters, [self.collider]);
        world.broad_phase.update(parameters, &world.colliders, &world.bodies, &moved, &[], pair_events);
        pair_events.len()
    }

    /// How deep the ball reaches into a wall now (units), by rapier's own contacts.
    pub fn penetration(&self) -> f64 {
        let pairs = self.world.narrow_phase.contact_pairs_with(self.collider);
        let depths = pairs.filter_map(|pair| pair.find_deepest_contact().map(|(_, contact)| -contact.dist));
        f64::from(depths.fold(0.0, f32::max))
    }
}

impl Engine for RapierEngine {
    /// `n_hits` is 1 when a velocity component changed its sign against the acceleration, as only a bounce makes it.
    fn tick_observed(
        &mut self,
        acceleration: Vector2<f64>,
        _observer: &mut dyn Observer,
    ) -> Result<Tick, OutOfRange> {
        if !acceleration.iter().all(|value| value.is_finite()) {
            return Err(OutOfRange::not_finite("the acceleration"));
        }
        let before = self.ball().velocity;
        self.step(acceleration);
        let after = self.ball().velocity;
        let bounced =
            |axis: usize| before[axis] * after[axis] < 0.0 && 0.0 <= before[axis] * acceleration[axis];
        let speeds = [0, 1].into_iter().filter(|axis| bounced(*axis)).map(|axis| before[axis].abs());
        let hardest_hit_speed = speeds.fold(0.0, f64::max);
        Ok(Tick {
            n_steps: 1,
            n_hits: u32::from(0.0 < hardest_hit_speed),
            hardest_hit_speed,
            deepest_penetration: self.penetration(),
            ..Tick::default()
        })
    }

    fn ball(&self) -> Ball {
        let body = &self.world.bodies[self.body];
        let planar = |vector: Vector| Vector2::new(f64::from(vector.x), f64::from(vector.y));
        Ball { position: planar(body.translation()), velocity: planar(body.linvel()) }
    }

    fn place(&mut self, ball: Ball) -> Result<(), OutOfRange> {
        let ball = ball.checked()?;
        let body = &mut self.world.bodies[self.body];
        body.set_translation(in_plane(ball.position), true);
        body.set_linvel(in_plane(ball.velocity), true);
        Ok(())
    }

    fn spec(&self) -> &BallSpec {
        &self.spec
    }

    fn tick_s(&self) -> f64 {
        self.tick_s
    }
}

/// A ball that is held in the plane and meets no other ball.
fn ball_builders(spec: &BallSpec, ball: Ball) -> (RigidBodyBuilder, ColliderBuilder) {
    let body = RigidBodyBuilder::dynamic()
        .translation(in_plane(ball.position))
        .linvel(in_plane(ball.velocity))
        .enabled_translations(true, true, false)
        .lock_rotations()
        .can_sleep(false);
    let shape = ColliderBuilder::ball(to_f32(spec.radius.units()))
        .restitution(to_f32(spec.restitution))
        .friction(0.0)
        .collision_groups(InteractionGroups::new(
            BALLS,
            Group::ALL.difference(BALLS),
            InteractionTestMode::And,
        ));
    (body, shape)
}

/// A world that steps by `tick_s`, as rapier comes, but without its bound on the speed.
pub(super) fn world(tick_s: f64) -> PhysicsWorld {
    let mut world = PhysicsWorld::default();
    world.integration_parameters.dt = to_f32(tick_s);
    world.integration_parameters.normalized_max_linear_velocity = f32::MAX;
    world
}

/// The walls of a board, from `middle - half_height` to `middle + half_height`.
pub(super) fn colliders(
    board: &Board,
    walls: Walls,
    half_height: f32,
    middle: f32,
) -> Result<Vec<ColliderBuilder>, OutOfRange> {
    let cuboids = board.rectangles().iter().map(|wall| {
        let (half, at) = (wall.size() / 2.0, in_plane((wall.low + wall.high) / 2.0));
        let at = at + Vector::Z * middle;
        (at, SharedShape::cuboid(to_f32(half.x), to_f32(half.y), half_height))
    });
    match walls {
        Walls::Cuboids => {
            Ok(cuboids.map(|(at, cuboid)| ColliderBuilder::new(cuboid).translation(at)).collect())
        }
        // rapier takes no compound of nothing.
        Walls::Compound if board.rectangles().is_empty() => Ok(Vec::new()),
        Walls::Compound => {
            let parts = cuboids.map(|(at, cuboid)| (Pose::from_translation(at), cuboid)).collect();
            Ok(vec![ColliderBuilder::compound(parts)])
        }
        Walls::TriangleMesh => triangle_mesh(board, half_height, middle),
    }
}

fn triangle_mesh(board: &Board, half_height: f32, middle: f32) -> Result<Vec<ColliderBuilder>, OutOfRange> {
    let mesh = board.mesh();
    if mesh.triangles.is_empty() {
        return Ok(Vec::new());
    }
    let vertex =
        |[x, y, z]: [f64; 3]| in_plane(Vector2::new(x, y)) + Vector::Z * (middle + half_height * to_f32(z));
    let vertices = mesh.vertices.into_iter().map(vertex).collect();
    let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
    ColliderBuilder::trimesh_with_flags(vertices, mesh.triangles, flags).map(|mesh| vec![mesh]).map_err(
        |_| OutOfRange { what: "the walls", expected: "a shape that rapier makes a triangle mesh of" },
    )
}

pub(super) fn in_plane(vector: Vector2<f64>) -> Vector {
    Vector::new(to_f32(vector.x), to_f32(vector.y), 0.0)
}

#[allow(clippy::cast_possible_truncation, reason = "rapier computes in f32")]
pub(super) fn to_f32(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use maze_core::Bounds;
    use maze_core::{Continuous, SortedPlanes};

    fn corridor() -> Board {
        let wall = |y: f64| Bounds { low: Vector2::new(-9.0, y), high: Vector2::new(9.0, y + 0.2) };
        Board::from_rectangles(vec![wall(-0.7), wall(0.5)]).unwrap()
    }

    fn engine(walls: Walls) -> RapierEngine {
        let ball = Ball { position: Vector2::new(-3.0, 0.0), velocity: Vector2::new(1.0, 2.0) };
        RapierEngine::new(&corridor(), walls, BallSpec::default(), ball, 0.03).unwrap()
    }

    #[test]
    fn a_compound_is_the_same_walls_as_its_cuboids() {
        let [mut compound, mut cuboids] = [Walls::Compound, Walls::Cuboids].map(engine);
        for _ in 0..100 {
            compound.step(Vector2::zeros());
            cuboids.step(Vector2::zeros());
            assert_eq!(compound.ball(), cuboids.ball());
        }
        assert!(cuboids.ball().position.y.abs() < 0.2 && cuboids.ball().velocity.y.abs() < 1.0, "it bounced");
    }

    #[test]
    fn a_steel_ball_stops_as_ours_does() {
        let ball = Ball { position: Vector2::zeros(), velocity: Vector2::new(1.0, 0.0) };
        let spec = maze_core::BallKind::Steel.spec(BallSpec::RADIUS);
        let planes = std::sync::Arc::new(SortedPlanes::new([]).unwrap());
        let board = Board::from_planes(&planes);
        let mut rapier = RapierEngine::new(&board, Walls::Cuboids, spec, ball, 0.03).unwrap();
        let mut ours = Continuous::new(planes, spec, ball, 0.03).unwrap();
        for _ in 0..60 {
            rapier.step(Vector2::new(0.0, 0.1));
            ours.tick(Vector2::new(0.0, 0.1)).unwrap();
        }
        assert_eq!((rapier.ball().velocity, ours.ball().velocity), (Vector2::zeros(), Vector2::zeros()));
        // rapier takes a tick's acceleration before its path: half a tick's gain in speed more each tick.
        assert!((rapier.ball().position - ours.ball().position).norm() < 0.01);
    }

    #[test]
    fn without_ccd_a_fast_ball_passes_through() {
        let beyond = [true, false].map(|is_on| {
            let mut engine = engine(Walls::Compound);
            engine.set_ccd(is_on);
            engine.place(Ball { position: Vector2::zeros(), velocity: Vector2::new(0.0, 300.0) }).unwrap();
            engine.step(Vector2::zeros());
            engine.ball().position.y
        });
        assert!(beyond[0] < 0.5 && 1.0 < beyond[1], "{beyond:?}");
    }

    #[test]
    fn the_broad_phase_alone_sees_walls_come_and_go() {
        let mut engine = engine(Walls::Cuboids);
        engine.step(Vector2::zeros());
        let events = [0.0, 0.14, 0.14, -0.14].map(|y| engine.update_broad_phase(Vector2::new(0.0, y)));
        // Clear of both walls, near the upper one, still there, near the lower one instead.
        assert_eq!(events, [0, 1, 0, 2]);
    }

    #[test]
    fn balls_of_one_world_do_not_meet() {
        let alone = {
            let mut engine = engine(Walls::Compound);
            (0..100).for_each(|_| engine.step(Vector2::zeros()));
            engine.ball()
        };
        let mut engine = engine(Walls::Compound);
        let head_on = Ball { position: Vector2::new(-2.0, 0.0), velocity: Vector2::new(-1.0, 2.0) };
        engine.add_balls([head_on].into_iter()).unwrap();
        (0..100).for_each(|_| engine.step(Vector2::zeros()));
        assert!((engine.ball().position - alone.position).norm() < 1.0e-5);
    }
}
