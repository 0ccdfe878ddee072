//! The shaders' texts: what all passes share, put before each pass's own text.

/// The complete text of one pass's shader.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// File name in `src/shader`, for messages.
    pub name: &'static str,
    /// WGSL, checked by naga in `tests/shaders.rs`.
    pub wgsl: &'static str,
    /// What a pipeline may start with.
    pub entry_points: &'static [&'static str],
}

macro_rules! shader {
    ([$($file:literal),+], $entry_points:expr) => {
        Shader {
            name: [$($file),+][[$($file),+].len() - 1],
            wgsl: concat!($(include_str!(concat!("shader/", $file))),+),
            entry_points: $entry_points,
        }
    };
}

pub(crate) const SHADOW: Shader = shader!(["frame.wgsl", "shadow.wgsl"], &["vertex"]);
pub(crate) const BACKGROUND: Shader =
    shader!(["frame.wgsl", "output.wgsl", "background.wgsl"], &["vertex", "fragment"]);
pub(crate) const MAZE: Shader = shader!(
    ["frame.wgsl", "output.wgsl", "lighting.wgsl", "material.wgsl", "marks.wgsl", "maze.wgsl"],
    &["vertex", "fragment"]
);
pub(crate) const BALL: Shader = shader!(
    ["frame.wgsl", "output.wgsl", "lighting.wgsl", "material.wgsl", "sphere.wgsl", "ball.wgsl"],
    &["vertex", "fragment"]
);
pub(crate) const GHOST: Shader =
    shader!(["frame.wgsl", "output.wgsl", "sphere.wgsl", "ghost.wgsl"], &["vertex", "fragment"]);
pub(crate) const FLOOR_LIGHT: Shader = shader!(
    ["frame.wgsl", "lighting.wgsl", "floor_light.wgsl"],
    &[
        "vertex_sky",
        "fragment_sky",
        "fragment_day",
        "vertex_wall",
        "fragment_wall",
        "vertex_soft",
        "fragment_soft",
        "vertex_ball",
        "fragment_ball",
    ]
);
pub(crate) const PLAIN: Shader = shader!(
    ["frame.wgsl", "output.wgsl", "lighting.wgsl", "material.wgsl", "marks.wgsl", "plain.wgsl"],
    &[
        "vertex",
        "fragment",
        "vertex_floor",
        "fragment_floor",
        "vertex_edge",
        "fragment_edge",
        "vertex_mark",
        "fragment_mark",
    ]
);

pub(crate) const LINES: Shader =
    shader!(["frame.wgsl", "output.wgsl", "lines.wgsl"], &["vertex", "fragment"]);
pub(crate) const PAINT: Shader = shader!(["output.wgsl", "paint.wgsl"], &["vertex", "fragment"]);

/// Every shader the renderer compiles.
pub const SHADERS: [Shader; 9] = [SHADOW, BACKGROUND, MAZE, BALL, GHOST, FLOOR_LIGHT, PLAIN, LINES, PAINT];

impl Shader {
    pub(crate) fn module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.wgsl.into()),
        })
    }
}
