//! Shaders are checked without a graphics card: naga validates each, and its structs match ours byte for byte.

use maze_render::pass::{Frame, Material};
use maze_render::{SHADERS, Shader};
use naga::valid::{Capabilities, ValidationFlags, Validator};

fn parsed(shader: &Shader) -> naga::Module {
    naga::front::wgsl::parse_str(shader.wgsl)
        .unwrap_or_else(|e| panic!("{}: {}", shader.name, e.emit_to_string(shader.wgsl)))
}

#[test]
fn every_shader_is_valid_and_has_the_entry_points_its_pass_names() {
    for shader in &SHADERS {
        let module = parsed(shader);
        // No capability: nothing beyond what WebGL2 draws with.
        Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&module)
            .unwrap_or_else(|e| panic!("{}: {}", shader.name, e.emit_to_string(shader.wgsl)));
        let entry_points: Vec<_> = module.entry_points.iter().map(|e| e.name.as_str()).collect();
        assert_eq!(entry_points, shader.entry_points, "{}", shader.name);
    }
}

#[test]
fn every_wgsl_file_is_compiled() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/shader");
    for entry in std::fs::read_dir(folder).unwrap() {
        let text = std::fs::read_to_string(entry.unwrap().path()).unwrap();
        assert!(SHADERS.iter().any(|s| s.wgsl.contains(&text)));
    }
}

/// Size, and the offset of each member, as the shader sees them.
fn layout(module: &naga::Module, name: &str) -> Option<(u32, Vec<(String, u32)>)> {
    module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).map(|(_, t)| match &t.inner {
        naga::TypeInner::Struct { members, span } => {
            (*span, members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect())
        }
        other => panic!("{name} is {other:?}"),
    })
}

macro_rules! our_layout {
    ($type:ty: $($field:ident),+) => {
        (
            u32::try_from(size_of::<$type>()).unwrap(),
            vec![$((stringify!($field).to_owned(), u32::try_from(std::mem::offset_of!($type, $field)).unwrap())),+],
        )
    };
}

#[test]
fn uniforms_have_the_same_layout_on_both_sides() {
    let frame = our_layout!(Frame: clip_from_maze, maze_from_clip, sun_clip_from_maze, eye, sun, up, sky, ball,
        ball_rotation, start, goal, board, occlusion, shadow, floor, ghost);
    let material = our_layout!(Material: mean, repeats_per_unit, roughness, reflectance, unused);
    let mut n_materials = 0;
    for shader in &SHADERS {
        let module = parsed(shader);
        // What is painted over a picture knows nothing of the maze.
        let expected = (shader.name != "paint.wgsl").then(|| frame.clone());
        assert_eq!(layout(&module, "Frame"), expected, "{}", shader.name);
        if let Some(found) = layout(&module, "Material") {
            assert_eq!(found, material, "{}", shader.name);
            n_materials += 1;
        }
    }
    assert_eq!(n_materials, 3);
}
