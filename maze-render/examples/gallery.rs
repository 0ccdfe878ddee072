//! Writes pictures of a test maze to look at: `cargo run -p maze-render --example gallery [FOLDER]`.
//! Uses `assets/textures/*.bmp`, or plain colours where they are missing.

use std::path::Path;

use maze_render::{CAPTURE_FORMAT, Camera, Gpu, Quality, Renderer, TextureSet, capture, decode_texture};
use nalgebra::{UnitQuaternion, Vector3};

#[path = "../tests/support/mod.rs"]
mod support;

use support::Board;

/// Frames timed for each picture.
const N_TIMED: u32 = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "target/gallery".to_owned());
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let gpu = Gpu::offscreen()?;
    println!("{}", gpu.describe());
    let textures = textures()?;
    let mut renderer = Renderer::with_quality(&gpu, CAPTURE_FORMAT, &textures, Quality::High);
    let mut save = |name: &str, board: &Board, size: [u32; 2], tilt: [f32; 2], zoom: Option<f32>| {
        renderer.set_maze(&gpu, &board.mesh())?;
        let mut scene = board.scene(size[0] as f32 / size[1] as f32);
        let [x, y] = board.cell(board.n_cells[0] / 2, board.n_cells[1] / 2);
        scene.ball.position = [x, y, scene.ball.radius];
        scene.ball.rotation = UnitQuaternion::from_euler_angles(0.5, 0.3, 0.2);
        scene.world_from_maze = UnitQuaternion::from_scaled_axis(Vector3::new(tilt[0], tilt[1], 0.0));
        if let Some(distance) = zoom {
            scene.camera = Camera { target: [x, y, 0.0], distance, pitch_rad: maze_render::PITCH_RAD };
        }
        let begun = std::time::Instant::now();
        let picture = capture(&gpu, &mut renderer, size, &scene)?;
        let first = begun.elapsed();
        let begun = std::time::Instant::now();
        let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: CAPTURE_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
            view_formats: &[],
        });
        for _ in 0..N_TIMED {
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            renderer.draw(&gpu, &mut encoder, &target.create_view(&Default::default()), size, &scene);
            gpu.queue.submit([encoder.finish()]);
            gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
        }
        println!("{name}: first picture {first:?}, then {:?} a frame", begun.elapsed() / N_TIMED);
        picture.save(folder.join(format!("{name}.png")))?;
        Ok::<_, Box<dyn std::error::Error>>(())
    };
    let board = Board::carved(12, 8, 7);
    save("level", &board, [1280, 720], [0.0, 0.0], None)?;
    save("tilted", &board, [1280, 720], [0.18, 0.18], None)?;
    save("close", &board, [1280, 720], [0.1, -0.1], Some(7.0))?;
    save("ball", &board, [720, 720], [0.0, 0.0], Some(2.2))?;
    save("tall", &board, [480, 900], [0.0, 0.0], None)?;
    save("large", &Board::carved(60, 40, 3), [1280, 720], [0.0, 0.1], None)?;
    save("tiny", &Board::carved(4, 3, 3), [640, 360], [0.0, 0.1], None)?;
    Ok(())
}

fn textures() -> Result<TextureSet, Box<dyn std::error::Error>> {
    let read = |name: &str, colour| match std::fs::read(format!("assets/textures/{name}.bmp")) {
        Ok(bytes) => Ok(decode_texture(name, &bytes)?),
        Err(_) => Ok::<_, Box<dyn std::error::Error>>(image::RgbImage::from_pixel(4, 4, image::Rgb(colour))),
    };
    Ok(TextureSet {
        wall: read("wall", [150, 80, 60])?,
        floor: read("floor", [176, 130, 86])?,
        top: read("top", [150, 148, 142])?,
    })
}
