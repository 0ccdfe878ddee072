// The shadow map: depth only.

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    return frame.sun_clip_from_maze * vec4(position, 1.0);
}
