// Coloured lines and patches in maze space, over everything: what the method sees.

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec4<f32>,
    @location(1) across: vec2<f32>, // from the line's middle; half its width (pixels)
}

// From `position` the line goes to its other end at `towards`; the corner is moved to the right of that direction by `offset.x`
// pixels. `offset.y` is 1 at one end and -1 at the other, whose right is the first one's left. A patch's corners stay.
@vertex
fn vertex(
    @location(0) position: vec3<f32>,
    @location(1) towards: vec3<f32>,
    @location(2) offset: vec2<f32>,
    @location(3) half_width: f32,
    @location(4) colour: vec4<f32>,
) -> Corner {
    let pixel = vec2(frame.eye.w, frame.sun.w);
    let clip = frame.clip_from_maze * vec4(position, 1.0);
    let other = frame.clip_from_maze * vec4(towards, 1.0);
    let line = (other.xy / max(other.w, 1e-4) - clip.xy / max(clip.w, 1e-4)) / pixel;
    let along = line / max(length(line), 1e-4);
    let right = vec2(along.y, -along.x);
    let moved = clip.xy + right * offset.x * pixel * clip.w;
    return Corner(vec4(moved, clip.zw), colour, vec2(offset.x * offset.y, half_width));
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let cover = clamp(in.across.y + 0.5 - abs(in.across.x), 0.0, 1.0);
    return vec4(from_encoded(in.colour.rgb), in.colour.a * cover);
}
