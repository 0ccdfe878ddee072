// What a surface is made of, and its corners.

struct Material {
    mean: vec4<f32>,
    repeats_per_unit: f32,
    roughness: f32,
    reflectance: f32,
    unused: f32,
}

const WALL = 0u;
const TOP = 1u;
const FLOOR = 2u;
const RIM = 3u;

// Which of these is drawn: known when the pipeline is made.
override kind: u32 = 0u;

// Walls are seen at a flat angle: where samples are not spread along it, the level that suits their short side would wash
// out the bricks on the long one.
override wall_bias: f32 = -1.2;

@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var surface_texture: texture_2d<f32>;
@group(2) @binding(2) var surface_sampler: sampler;
// How the surface leans along the texture's axes, -1 to 1 as 0 to 1: bricks stand out from their joints.
@group(2) @binding(3) var relief_texture: texture_2d<f32>;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

// Pictures have their first row on top.
fn surface_uv(uv: vec2<f32>) -> vec2<f32> {
    return vec2(uv.x, -uv.y) * material.repeats_per_unit;
}

