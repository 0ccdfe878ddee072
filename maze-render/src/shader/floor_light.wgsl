// The map of the floor's light: r the sun past the walls, g the sky past the walls (its root, as eyes see it), b the sun past
// the ball, a the sky past the ball (its root). Green stays from frame to frame. Everything casts straight onto the floor's plane, so that the map has the maze's own axes.

struct Place {
    @builtin(position) clip: vec4<f32>,
    @location(0) maze: vec2<f32>,
}

fn place(maze: vec2<f32>) -> Place {
    let uv = maze * frame.occlusion.xy + frame.occlusion.zw;
    return Place(vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.5, 1.0), maze);
}

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
}

// Where light that passes p meets the floor.
fn on_floor(p: vec3<f32>) -> vec2<f32> {
    return p.xy - frame.sun.xy * (p.z / max(frame.sun.z, 0.1));
}

@vertex
fn vertex_sky(@builtin(vertex_index) index: u32) -> Place {
    let uv = vec2(f32((index & 1u) << 1u), f32(index & 2u));
    return place((uv - frame.occlusion.zw) / frame.occlusion.xy);
}

@fragment
fn fragment_sky(in: Place) -> @location(0) vec4<f32> {
    return vec4(1.0, sqrt(sky_over_floor(in.maze)), 1.0, 1.0);
}

@fragment
fn fragment_day(in: Place) -> @location(0) vec4<f32> {
    return vec4(1.0);
}

@vertex
fn vertex_wall(in: Vertex) -> Place {
    return place(on_floor(in.position));
}

@fragment
fn fragment_wall(in: Place) -> @location(0) vec4<f32> {
    return vec4(0.0);
}

struct Soft {
    @builtin(position) clip: vec4<f32>,
    @location(0) light: f32,
}

// A strip along the outline of a wall's shadow, from dark to light over a texel or more: smooth, and it moves smoothly,
// with one sample a texel. The normal holds the direction out of the wall in x and y, and in z 1 at the outer end; or only
// z, -1 or 1 at an outer end, for the direction across the sun's light.
@vertex
fn vertex_soft(in: Vertex) -> Soft {
    let across = vec2(-frame.sun.y, frame.sun.x) / max(length(frame.sun.xy), 1e-3);
    let is_corner = all(in.normal.xy == vec2(0.0));
    let out = select(in.normal.xy * in.normal.z, across * in.normal.z, is_corner);
    let place = place(on_floor(in.position) + out * frame.shadow.w);
    return Soft(place.clip, abs(in.normal.z));
}

@fragment
fn fragment_soft(in: Soft) -> @location(0) vec4<f32> {
    return vec4(in.light);
}

// A square that holds what the ball keeps from the floor.
@vertex
fn vertex_ball(@builtin(vertex_index) index: u32) -> Place {
    let corner = vec2(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let middle = 0.5 * (frame.ball.xy + on_floor(frame.ball.xyz));
    return place(middle + corner * 4.0 * frame.ball.w);
}

@fragment
fn fragment_ball(in: Place) -> @location(0) vec4<f32> {
    let p = vec3(in.maze, 0.0);
    return vec4(1.0, 1.0, sun_past_ball(p), sqrt(sky_past_ball(p, vec3(0.0, 0.0, 1.0))));
}
