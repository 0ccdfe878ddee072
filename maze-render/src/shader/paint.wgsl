// Flat triangles over the picture: letters and panels.

struct Screen {
    size: vec2<f32>, // in the units of the corners
    unused: vec2<f32>,
}

@group(0) @binding(0) var<uniform> screen: Screen;
@group(0) @binding(1) var atlas: texture_2d<f32>;
@group(0) @binding(2) var atlas_sampler: sampler;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) colour: vec4<f32>,
}

@vertex
fn vertex(@location(0) position: vec2<f32>, @location(1) uv: vec2<f32>, @location(2) colour: vec4<f32>) -> Corner {
    let p = position / screen.size;
    return Corner(vec4(2.0 * p.x - 1.0, 1.0 - 2.0 * p.y, 0.0, 1.0), uv, colour);
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let colour = in.colour * textureSample(atlas, atlas_sampler, in.uv);
    return vec4(from_encoded(colour.rgb), colour.a);
}
