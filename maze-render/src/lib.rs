//! Draws a maze, a ball and overlays to a window or to a picture, with wgpu.
//!
//! # Conventions
//!
//! * Right-handed frames. Maze frame: x right, y away from the player, z out of the board; the board's centre is
//!   the origin and the floor is `z = 0`. World = maze frame turned about the origin by
//!   [`Scene::world_from_maze`]. View frame: x right, y up on the screen, z towards the eye.
//! * Transforms are named `target_from_source`. Lengths are maze units: a corridor is about 1 wide.
//! * Light is fixed in the world; shaders work in the maze frame, so the sun and the eye are turned into it once a
//!   frame on the CPU.
//! * Windows and pictures share every pass: [`Renderer::draw`] takes any texture view of the format it was made for.
//!
//! ```no_run
//! # use maze_core::surface::SurfaceMesh;
//! # fn draw(
//! #     textures: maze_render::TextureSet,
//! #     mesh: SurfaceMesh,
//! #     scene: maze_render::Scene,
//! # ) -> Result<(), Box<dyn std::error::Error>> {
//! let gpu = maze_render::Gpu::offscreen()?;
//! let mut renderer = maze_render::Renderer::new(&gpu, maze_render::CAPTURE_FORMAT, &textures);
//! renderer.set_maze(&gpu, &mesh)?;
//! maze_render::capture(&gpu, &mut renderer, [1280, 720], &scene)?.save("maze.png")?;
//! # Ok(()) }
//! ```
//!
//! The crate depends on no window events, reads no files and no clock, and starts no thread, so that it also builds for
//! the browser.
#![forbid(unsafe_code)]

mod camera;
mod capture;
mod gpu;
mod light;
mod mesh;
mod occlusion;
mod paint;
pub mod pass;
mod quality;
mod renderer;
mod scene;
mod shader;
mod texture;
mod timer;

pub use camera::{Camera, FIELD_OF_VIEW_RAD, PITCH_RAD};
pub use capture::{CAPTURE_FORMAT, capture, capture_over};
pub use gpu::{Acquired, Gpu, GpuError, WindowTarget};
pub use paint::{PaintBatch, PaintVertex, Painter};
pub use quality::Quality;
pub use renderer::Renderer;
pub use scene::{BallView, GhostView, Line, Marker, Patch, Scene};
pub use shader::{SHADERS, Shader};
pub use texture::{TextureError, TextureSet, decode_texture};
pub use timer::GpuTimer;
