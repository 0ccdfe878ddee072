//! What a frame of each quality costs on the software driver: `cargo run -p maze-render --example frame_cost`.
//!
//! 1280x720, the default maze, the board turning all the time. The qualities take turns, so that a busy machine slows them
//! alike; the time of the processor, over all threads, says more than the clock. Linux only: it reads /proc.
#![allow(clippy::cast_possible_truncation, reason = "drawing needs no more than f32")]

use maze_core::{AssembleOptions, Maze, import};
use maze_render::{BallView, Camera, Gpu, Marker, Quality, Renderer, Scene, TextureSet, capture, decode_bmp};
use nalgebra::{UnitQuaternion, Vector3};
use std::time::{Duration, Instant};

type AnyError = Box<dyn std::error::Error>;

const SIZE: [u32; 2] = [1280, 720];
const N_ROUNDS: u16 = 6;
const N_FRAMES: u16 = 10;

/// Time of the processor that all threads have had.
fn processor_time() -> Result<Duration, AnyError> {
    let mut sum = Duration::ZERO;
    for thread in std::fs::read_dir("/proc/self/task")? {
        let text = std::fs::read_to_string(thread?.path().join("schedstat"))?;
        sum += Duration::from_nanos(text.split(' ').next().unwrap_or_default().parse()?);
    }
    Ok(sum)
}

fn main() -> Result<(), AnyError> {
    let gpu = Gpu::offscreen_software()?;
    println!("{}", gpu.describe());
    let read = |name| {
        decode_bmp(name, &std::fs::read(format!("assets/textures/{name}.bmp"))?).map_err(AnyError::from)
    };
    let textures = TextureSet { wall: read("wall")?, floor: read("floor")?, top: read("top")? };
    let mesh = import::obj::read(&std::fs::read("assets/mazes/default.obj")?)?;
    let maze = Maze::from_polygons(&mesh, &AssembleOptions::default())?;
    let mut contenders = Vec::new();
    for quality in Quality::ALL {
        let format = quality.picture_format();
        let mut renderer = Renderer::with_quality(&gpu, format, &textures, quality);
        renderer.set_maze(&gpu, &maze.surface)?;
        contenders.push((renderer, target(&gpu, format), Duration::ZERO, Duration::ZERO));
    }
    for round in 0..N_ROUNDS {
        for (renderer, view, clock, processor) in &mut contenders {
            let (begun, used) = (Instant::now(), processor_time()?);
            for frame in 0..N_FRAMES {
                let scene = scene(&maze, 0.05 * f32::from(round * N_FRAMES + frame));
                let mut encoder = gpu.device.create_command_encoder(&Default::default());
                renderer.draw(&gpu, &mut encoder, view, SIZE, &scene);
                gpu.queue.submit([encoder.finish()]);
                gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
            }
            // The first round also compiles.
            if 0 < round {
                *clock += begun.elapsed();
                *processor += processor_time()? - used;
            }
        }
    }
    let n_frames = f64::from((N_ROUNDS - 1) * N_FRAMES);
    let ms = |time: Duration| time.as_secs_f64() * 1.0e3 / n_frames;
    for (mut renderer, _, clock, processor) in contenders {
        let name = renderer.quality().name();
        println!("{name:6}  {:6.2} ms a frame, {:6.2} ms of the processor", ms(clock), ms(processor));
        if let Some(folder) = std::env::args().nth(1) {
            capture(&gpu, &mut renderer, SIZE, &scene(&maze, 1.0))?.save(format!("{folder}/{name}.png"))?;
        }
    }
    gpu.take_error().map_or(Ok(()), |error| Err(error.into()))
}

fn target(gpu: &Gpu, format: wgpu::TextureFormat) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    texture.create_view(&Default::default())
}

fn scene(maze: &Maze, turn: f32) -> Scene {
    let size = maze.bounds.size();
    let half_size = [size.x as f32 / 2.0, size.y as f32 / 2.0, maze.wall_height as f32];
    let radius = maze.ball_radius.units() as f32;
    let [start, goal] = [maze.start, maze.goal].map(|place| [place.x as f32, place.y as f32]);
    let tilt = Vector3::new(0.2 * turn.sin(), 0.2 * turn.cos(), 0.0);
    Scene {
        camera: Camera::fitted(half_size, SIZE[0] as f32 / SIZE[1] as f32, 0.35),
        world_from_maze: UnitQuaternion::from_scaled_axis(tilt),
        ball: BallView {
            position: [start[0] + 0.2, start[1], radius],
            radius,
            rotation: UnitQuaternion::identity(),
        },
        ghost: None,
        start: Marker { position: start, radius: maze.goal_radius as f32 },
        goal: Marker { position: goal, radius: maze.goal_radius as f32 },
        goal_glow: 0.5,
        lines: vec![],
        patches: vec![],
        shows_maze: true,
    }
}
