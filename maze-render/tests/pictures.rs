//! What the pictures show. Needs a driver: `apt-get install mesa-vulkan-drivers` gives one to any machine.

use image::{Rgb, RgbImage, Rgba, RgbaImage};
use maze_render::{
    CAPTURE_FORMAT, GhostView, Gpu, GpuError, Line, Patch, Quality, Renderer, Scene, TextureSet, capture,
};
use nalgebra::{UnitQuaternion, Vector3};

mod support;

use support::{Board, WALL_HEIGHT, WALL_THICKNESS, flat_textures};

const SIZE: [u32; 2] = [320, 240];
const ASPECT: f32 = 4.0 / 3.0;
const GREY: [u8; 3] = [120; 3];

/// A software device for each quality, whose name is shown when the test fails.
fn every_quality() -> impl Iterator<Item = (Gpu, Quality)> {
    Quality::ALL.into_iter().map(|quality| {
        println!("{quality:?}");
        (Gpu::offscreen_software().expect("a software driver"), quality)
    })
}

fn drawn(gpu: &Gpu, quality: Quality, textures: &TextureSet, board: &Board, scene: &Scene) -> RgbaImage {
    let mut renderer = Renderer::with_quality(gpu, quality.picture_format(), textures, quality);
    renderer.set_maze(gpu, &board.mesh()).expect("a maze that fits");
    capture(gpu, &mut renderer, SIZE, scene).expect("a picture")
}

/// The pixel that shows a point given in the maze frame.
fn pixel(picture: &RgbaImage, scene: &Scene, maze: [f32; 3]) -> [u8; 3] {
    let world = scene.world_from_maze * Vector3::from(maze);
    let at = scene.camera.project(picture.dimensions().into(), world.into()).expect("in front");
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "inside the picture")]
    let [x, y] = at.map(|c| c as u32);
    let [r, g, b, _] = picture.get_pixel(x, y).0;
    [r, g, b]
}

fn n_different(a: &RgbaImage, b: &RgbaImage) -> usize {
    assert_eq!(a.dimensions(), b.dimensions());
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

fn strongest(colour: [u8; 3]) -> usize {
    let most = (0..3).max_by_key(|&i| colour[i]).expect("three");
    let others = (0..3).filter(|&i| i != most).map(|i| colour[i]).max().expect("two");
    assert!(u32::from(others) * 3 < u32::from(colour[most]) * 2, "no clear colour: {colour:?}");
    most
}

#[test]
fn each_surface_shows_its_own_texture() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(5, 4);
        let scene = board.bare_scene(ASPECT);
        let [hx, hy, _] = board.half_size();
        let far_wall_foot = hy - WALL_THICKNESS;
        let picture =
            drawn(&gpu, quality, &flat_textures([200, 10, 10], [10, 200, 10], [10, 10, 200]), &board, &scene);
        assert_eq!(
            strongest(pixel(&picture, &scene, [0.3, far_wall_foot, 0.5 * WALL_HEIGHT])),
            0,
            "wall: red"
        );
        assert_eq!(strongest(pixel(&picture, &scene, [0.3, -0.4, 0.0])), 1, "floor: green");
        assert_eq!(
            strongest(pixel(&picture, &scene, [0.3, hy - 0.5 * WALL_THICKNESS, WALL_HEIGHT])),
            2,
            "top: blue"
        );
        assert_eq!(strongest(pixel(&picture, &scene, [hx - 0.5 * WALL_THICKNESS, 0.0, WALL_HEIGHT])), 2);
    }
}

#[test]
fn textures_repeat_once_a_unit_on_tops_and_every_three_on_the_floor() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(6, 4);
        let scene = board.bare_scene(ASPECT);
        // Dark left half, bright right half.
        let halves = RgbImage::from_fn(64, 64, |x, _| if x < 32 { Rgb([10; 3]) } else { Rgb([230; 3]) });
        let textures = TextureSet { wall: halves.clone(), floor: halves.clone(), top: halves };
        let picture = drawn(&gpu, quality, &textures, &board, &scene);
        let is_bright = |maze| 100 < pixel(&picture, &scene, maze)[1];
        for (x, bright) in [(0.75, false), (2.25, true), (-0.75, true), (-2.25, false)] {
            assert_eq!(is_bright([x, -0.3, 0.0]), bright, "floor at {x}");
        }
        let y = board.half_size()[1] - 0.5 * WALL_THICKNESS;
        for (x, bright) in [(0.25, false), (0.75, true), (1.25, false), (-0.25, true)] {
            assert_eq!(is_bright([x, y, WALL_HEIGHT]), bright, "top at {x}");
        }
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(6, 4, 1);
    let mut scene = board.scene(ASPECT);
    scene.world_from_maze = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, -0.05, 0.0));
    let textures = flat_textures([150, 80, 60], [176, 130, 86], GREY);
    let format = Quality::Low.picture_format();
    let mut renderer = Renderer::with_quality(&gpu, format, &textures, Quality::Low);
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    let first = capture(&gpu, &mut renderer, SIZE, &scene).unwrap();
    capture(&gpu, &mut renderer, [200, 300], &board.scene(1.5)).unwrap();
    assert_eq!(n_different(&first, &capture(&gpu, &mut renderer, SIZE, &scene).unwrap()), 0, "same renderer");
    let other_gpu = Gpu::offscreen_software().unwrap();
    assert_eq!(
        n_different(&first, &drawn(&other_gpu, Quality::Low, &textures, &board, &scene)),
        0,
        "another device"
    );
}

#[test]
fn the_ball_is_where_the_camera_says_and_its_pattern_turns() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(5, 4);
        let textures = flat_textures(GREY, GREY, GREY);
        let mut scene = board.scene(ASPECT);
        scene.world_from_maze = UnitQuaternion::from_scaled_axis(Vector3::new(0.2, -0.15, 0.0));
        scene.ball.position = [1.3, -0.7, 0.35];
        let with_ball = drawn(&gpu, quality, &textures, &board, &scene);
        let mut without = scene.clone();
        without.ball.radius = 0.0;
        let without_ball = drawn(&gpu, quality, &textures, &board, &without);
        let changed = |at| pixel(&with_ball, &scene, at) != pixel(&without_ball, &scene, at);
        let [x, y, z] = scene.ball.position;
        assert!(changed([x, y, z]) && changed([x + 0.25, y, z]) && changed([x, y + 0.25, z]));
        let beside = [x - 1.2, y, 0.0];
        let dimmed = pixel(&without_ball, &scene, beside)[1].abs_diff(pixel(&with_ball, &scene, beside)[1]);
        assert!(dimmed < 8, "the ball takes a little of the sky, no more: {dimmed}");
        assert!(changed([x + 0.42, y - 0.3, 0.0]), "its shadow falls away from the sun, to the lower right");

        let mut rolled = scene.clone();
        rolled.ball.rotation = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.2);
        let n_turned = n_different(&with_ball, &drawn(&gpu, quality, &textures, &board, &rolled));
        assert!(30 < n_turned, "a turn of 11 degrees shows: {n_turned} pixels");
    }
}

#[test]
fn walls_throw_shadows_away_from_the_sun() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(5, 4);
        let mut scene = board.scene(ASPECT);
        scene.ball.radius = 0.0;
        let picture = drawn(&gpu, quality, &flat_textures(GREY, GREY, GREY), &board, &scene);
        let left_foot = -board.half_size()[0] + WALL_THICKNESS;
        let in_shadow = pixel(&picture, &scene, [left_foot + 0.2, 0.0, 0.0])[1];
        let in_sun = pixel(&picture, &scene, [left_foot + 0.9, 0.0, 0.0])[1];
        let other_side = pixel(&picture, &scene, [-left_foot - 0.25, 0.0, 0.0])[1];
        assert!(in_shadow + 30 < in_sun, "{in_shadow} {in_sun}");
        assert!(in_shadow + 20 < other_side, "the sun is on the left: {in_shadow} {other_side}");
    }
}

#[test]
fn start_and_goal_differ_in_colour_and_the_goal_glows() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(5, 4);
        let textures = flat_textures(GREY, GREY, GREY);
        let mut scene = board.scene(ASPECT);
        scene.ball.position = [0.0, 0.0, 0.35];
        scene.goal_glow = 0.0;
        let picture = drawn(&gpu, quality, &textures, &board, &scene);
        let [sx, sy] = scene.start.position;
        let [gx, gy] = scene.goal.position;
        let green = pixel(&picture, &scene, [gx + 0.52 * scene.goal.radius, gy, 0.0]);
        assert_eq!(strongest(pixel(&picture, &scene, [sx, sy, 0.0])), 2, "a blue dot");
        assert_eq!(strongest(green), 1, "a green ring");
        scene.goal_glow = 1.0;
        let glowing = drawn(&gpu, quality, &textures, &board, &scene);
        assert!(green[1] + 10 < pixel(&glowing, &scene, [gx + 0.52 * scene.goal.radius, gy, 0.0])[1]);
    }
}

#[test]
fn any_size_works_and_an_impossible_one_says_so() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(4, 4, 2);
    let mut renderer =
        Renderer::with_quality(&gpu, CAPTURE_FORMAT, &flat_textures(GREY, GREY, GREY), Quality::High);
    let scene = board.scene(1.0);
    capture(&gpu, &mut renderer, [64, 48], &scene).expect("no maze yet: the table alone");
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    for size in [[1, 1], [3, 501], [501, 3], [65, 33]] {
        let picture = capture(&gpu, &mut renderer, size, &scene).unwrap();
        assert_eq!([picture.width(), picture.height()], size);
    }
    for size in [[0, 10], [10, 0], [gpu.max_side() + 1, 1]] {
        let refused = capture(&gpu, &mut renderer, size, &scene);
        assert!(matches!(refused, Err(GpuError::PictureSize { .. })), "{size:?}");
    }
    renderer.set_maze(&gpu, &maze_core::surface::SurfaceMesh::default()).unwrap();
    capture(&gpu, &mut renderer, [64, 48], &scene).expect("an empty maze");
    let without_triangles = maze_core::surface::SurfaceMesh { indices: Default::default(), ..board.mesh() };
    renderer.set_maze(&gpu, &without_triangles).unwrap();
    capture(&gpu, &mut renderer, [64, 48], &scene).expect("vertices alone");
}

#[test]
fn a_window_s_format_gives_the_same_picture() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(4, 3, 5);
    let textures = flat_textures([150, 80, 60], [176, 130, 86], GREY);
    let scene = board.scene(ASPECT);
    let expected = drawn(&gpu, Quality::High, &textures, &board, &scene);
    for format in [wgpu::TextureFormat::Bgra8UnormSrgb, wgpu::TextureFormat::Rgba8Unorm] {
        let mut renderer = Renderer::with_quality(&gpu, format, &textures, Quality::High);
        renderer.set_maze(&gpu, &board.mesh()).unwrap();
        let picture = capture(&gpu, &mut renderer, SIZE, &scene).unwrap();
        // Without an sRGB format edges are smoothed in encoded colours, so they differ; surfaces do not.
        let n_off = expected
            .pixels()
            .zip(picture.pixels())
            .filter(|(a, b)| (0..3).any(|i| 3 < a.0[i].abs_diff(b.0[i])))
            .count();
        let allowed = if format.is_srgb() { 0 } else { expected.pixels().len() / 10 };
        assert!(n_off <= allowed, "{format:?}: {n_off} pixels");
    }
}

#[test]
fn a_maze_that_cannot_be_drawn_says_so_and_leaves_the_last_one() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(4, 3, 5);
    let scene = board.scene(ASPECT);
    let mut renderer = Renderer::new(&gpu, CAPTURE_FORMAT, &flat_textures(GREY, GREY, GREY));
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    let expected = capture(&gpu, &mut renderer, SIZE, &scene).unwrap();

    let mut beyond = Board::carved(9, 9, 1).mesh();
    beyond.indices[1][4] = u32::MAX;
    let refused = renderer.set_maze(&gpu, &beyond);
    assert!(matches!(refused, Err(GpuError::VertexOutOfRange { index: u32::MAX, .. })), "{refused:?}");

    // More indices than fit into a buffer. Zeroes that nobody reads take no memory.
    let max = gpu.device.limits().max_buffer_size;
    assert!(max <= 1 << 32, "a software driver allows buffers of {max} bytes: test this another way");
    let n_indices = usize::try_from(max / 4 + 1).unwrap();
    let huge =
        maze_core::surface::SurfaceMesh { indices: [vec![], vec![], vec![0; n_indices]], ..board.mesh() };
    let refused = renderer.set_maze(&gpu, &huge);
    let n_bytes_needed = 4 * n_indices as u64;
    assert!(
        matches!(refused, Err(GpuError::MazeTooLarge { n_bytes, max: m }) if n_bytes == n_bytes_needed && m == max),
        "{refused:?}"
    );
    assert_eq!(n_different(&expected, &capture(&gpu, &mut renderer, SIZE, &scene).unwrap()), 0);
}

#[test]
fn the_software_driver_is_one() {
    let gpu = Gpu::offscreen_software().unwrap();
    assert_eq!(gpu.adapter_info.device_type, wgpu::DeviceType::Cpu, "{}", gpu.describe());
}

/// Mean of a picture's channels, 0 to 255.
fn mean(picture: &RgbaImage) -> [f64; 3] {
    let n_pixels = f64::from(picture.width() * picture.height());
    [0, 1, 2].map(|i| picture.pixels().map(|p| f64::from(p[i])).sum::<f64>() / n_pixels)
}

#[test]
fn every_quality_shows_the_same_scene_in_the_same_colours() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(6, 4, 1);
    let mut scene = board.scene(ASPECT);
    scene.world_from_maze = UnitQuaternion::from_scaled_axis(Vector3::new(0.1, -0.05, 0.0));
    let textures = flat_textures([150, 80, 60], [176, 130, 86], [190, 186, 178]);
    let best = drawn(&gpu, Quality::High, &textures, &board, &scene);
    for quality in [Quality::Low, Quality::Medium] {
        let other = drawn(&gpu, quality, &textures, &board, &scene);
        let (a, b) = (mean(&best), mean(&other));
        // Low has no bright spot where the floor mirrors the sun, and edges half a pixel farther out.
        assert!((0..3).all(|i| (a[i] - b[i]).abs() < 4.0), "{quality:?}: {a:?} {b:?}");
        let far = |(a, b): (&Rgba<u8>, &Rgba<u8>)| (0..3).any(|i| 40 < a.0[i].abs_diff(b.0[i]));
        let n_far = best.pixels().zip(other.pixels()).filter(|pair| far(*pair)).count();
        // Edges and the ball, which are much of a small picture.
        assert!(n_far < best.pixels().len() * 6 / 100, "{quality:?}: {n_far} pixels are another colour");
    }
}

#[test]
fn a_target_of_either_kind_shows_the_low_quality_the_same() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::carved(4, 3, 5);
    let textures = flat_textures([150, 80, 60], [176, 130, 86], GREY);
    let scene = board.scene(ASPECT);
    let plain = drawn(&gpu, Quality::Low, &textures, &board, &scene);
    let mut renderer = Renderer::with_quality(&gpu, CAPTURE_FORMAT, &textures, Quality::Low);
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    let srgb = capture(&gpu, &mut renderer, SIZE, &scene).unwrap();
    // What blends (marks, the ball's outline, edges) blends in light there, so only surfaces are the same.
    let is_off = |(a, b): &(&Rgba<u8>, &Rgba<u8>)| (0..3).any(|i| 3 < a.0[i].abs_diff(b.0[i]));
    let n_off = plain.pixels().zip(srgb.pixels()).filter(is_off).count();
    assert!(n_off < plain.pixels().len() / 12, "{n_off} pixels");
}

#[test]
fn a_lost_device_is_noticed_and_a_new_one_draws_the_same() {
    let board = Board::carved(4, 3, 5);
    let textures = flat_textures([150, 80, 60], [176, 130, 86], GREY);
    let scene = board.scene(ASPECT);
    let gpu = Gpu::offscreen_software().unwrap();
    let mut renderer = Renderer::new(&gpu, CAPTURE_FORMAT, &textures);
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    let before = capture(&gpu, &mut renderer, SIZE, &scene).unwrap();
    assert!(!gpu.is_lost());
    gpu.device.destroy();
    assert!(gpu.is_lost());
    let refused = capture(&gpu, &mut renderer, SIZE, &scene);
    assert!(matches!(refused, Err(GpuError::Device(_))), "{refused:?}");
    let refused = renderer.set_maze(&gpu, &board.mesh());
    assert!(matches!(refused, Err(GpuError::Device(_))), "{refused:?}");

    let gpu = Gpu::offscreen_software().unwrap();
    let mut renderer = Renderer::new(&gpu, CAPTURE_FORMAT, &textures);
    renderer.set_maze(&gpu, &board.mesh()).unwrap();
    assert_eq!(n_different(&before, &capture(&gpu, &mut renderer, SIZE, &scene).unwrap()), 0);
}

#[test]
fn a_driver_s_complaint_fails_the_picture() {
    let gpu = Gpu::offscreen_software().unwrap();
    let mut renderer = Renderer::new(&gpu, CAPTURE_FORMAT, &flat_textures(GREY, GREY, GREY));
    // A buffer that is mapped and copied to at once is against the rules.
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::MAP_WRITE;
    let descriptor = wgpu::BufferDescriptor { label: None, size: 16, usage, mapped_at_creation: false };
    drop(gpu.device.create_buffer(&descriptor));
    let refused = capture(&gpu, &mut renderer, [16, 16], &Board::empty(2, 2).scene(1.0));
    assert!(matches!(refused, Err(GpuError::Device(_))), "{refused:?}");
    capture(&gpu, &mut renderer, [16, 16], &Board::empty(2, 2).scene(1.0)).expect("told once");
}

#[test]
fn lines_and_patches_lie_over_walls_at_their_place_and_width() {
    let gpu = Gpu::offscreen_software().unwrap();
    let board = Board::empty(5, 4);
    let textures = flat_textures(GREY, GREY, GREY);
    for quality in Quality::ALL {
        let mut scene = board.scene(ASPECT);
        scene.ball.radius = 0.0;
        let without = drawn(&gpu, quality, &textures, &board, &scene);
        let [hx, hy, _] = board.half_size();
        // Across the whole board and through its walls.
        scene.lines =
            vec![Line { from: [-hx, 0.4, 0.3], to: [hx, 0.4, 0.3], width: 5.0, colour: [0, 255, 0, 255] }];
        let corners = [[-0.5, -hy, 0.0], [0.5, -hy, 0.0], [0.5, -hy + 0.5, 0.0], [-0.5, -hy + 0.5, 0.0]];
        scene.patches = vec![Patch { corners, colour: [255, 0, 0, 128] }];
        let with = drawn(&gpu, quality, &textures, &board, &scene);
        for x in [-hx + 0.1, 0.0, hx - 0.1] {
            assert_eq!(pixel(&with, &scene, [x, 0.4, 0.3]), [0, 255, 0], "{quality:?}");
        }
        let half_covered = pixel(&with, &scene, [0.0, -hy + 0.25, 0.0]);
        assert_eq!(strongest(half_covered), 0, "{quality:?}");
        assert!(20 < half_covered[1], "what lies below is seen through it: {half_covered:?}");
        // A column of pixels through the line: five of it, and one that it covers in part on either side.
        let x = with.width() / 2;
        let changed = (0..with.height()).filter(|&y| {
            let [r, g, b, _] = with.get_pixel(x, y).0;
            r < g && b < g && with.get_pixel(x, y) != without.get_pixel(x, y)
        });
        assert!((5..=7).contains(&changed.count()), "{quality:?}");
    }
}

#[test]
fn a_ghost_is_seen_through_and_hidden_by_what_is_nearer() {
    for (gpu, quality) in every_quality() {
        let board = Board::empty(5, 4);
        let mut scene = board.scene(ASPECT);
        scene.ball.position = [1.3, -0.7, 0.35];
        let with = |floor: u8, ghost: Option<[f32; 3]>| {
            let textures = flat_textures(GREY, [floor; 3], GREY);
            let ghost = ghost.map(|position| GhostView { position, radius: 0.35 });
            drawn(&gpu, quality, &textures, &board, &Scene { ghost, ..scene.clone() })
        };
        let at = |picture: &RgbaImage, place| pixel(picture, &scene, place);

        let place = [-1.0, 0.5, 0.35];
        let [without, dark, light] = [with(60, None), with(60, Some(place)), with(220, Some(place))];
        assert_ne!(at(&dark, place), at(&without, place), "it shows");
        assert!(at(&dark, place)[0].saturating_add(20) < at(&light, place)[0], "and the floor through it");
        let beside = [place[0] + 0.45, place[1], 0.35];
        assert_eq!(at(&dark, beside), at(&without, beside), "nowhere else");

        // The eye looks from above: a ghost below the ball is behind it, one around it in front.
        let ball = scene.ball.position;
        let [behind, around] = [with(60, Some([1.3, -0.7, -0.4])), with(60, Some(ball))];
        assert_eq!(at(&behind, ball), at(&without, ball));
        assert_ne!(at(&around, ball), at(&without, ball));
    }
}
