//! The shaders' texts: what all passes share, put before each pass's own text.

/// The complete text of one pass's shader.
#[derive(Clone, Copy, Debug)]
pub struct Shader {
    /// File name in `src/shader`, for messages.
    pub name: &'static str,
    /// WGSL, checked by naga in `tests/shaders.rs`.
    pub wgsl: &'static str,
}

macro_rules! shader {
    ($($file:literal),+) => {
        Shader { name: [$($file),+][[$($file),+].len() - 1], wgsl: concat!($(include_str!(concat!("shader/", $file))),+) }
    };
}

pub(crate) const SHADOW: Shader = shader!("frame.wgsl", "shadow.wgsl");
pub(crate) const BACKGROUND: Shader = shader!("frame.wgsl", "output.wgsl", "background.wgsl");
pub(crate) const MAZE: Shader = shader!("frame.wgsl", "output.wgsl", "lighting.wgsl", "maze.wgsl");
pub(crate) const BALL: Shader = shader!("frame.wgsl", "output.wgsl", "lighting.wgsl", "ball.wgsl");

/// Every shader the renderer compiles.
pub const SHADERS: [Shader; 4] = [SHADOW, BACKGROUND, MAZE, BALL];

impl Shader {
    pub(crate) fn module(&self, device: &wgpu::Device) -> wgpu::ShaderModule {
        device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(self.name),
            source: wgpu::ShaderSource::Wgsl(self.wgsl.into()),
        })
    }
}
