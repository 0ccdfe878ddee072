// A ball without a mesh. Its vec4 is centre and radius.

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
}

struct Seen {
    @location(0) colour: vec4<f32>,
    @builtin(frag_depth) depth: f32,
}

struct Met {
    position: vec3<f32>,
    // How much of the pixel the ball covers.
    cover: f32,
}

// A square across the line of sight that covers the ball's outline. The ball itself is met by each pixel's ray: round at
// any distance, and no more pixels are shaded than it has.
fn corner_around(ball: vec4<f32>, index: u32) -> Corner {
    let to_eye = frame.eye.xyz - ball.xyz;
    let distance = max(length(to_eye), 1.01 * ball.w);
    let forward = to_eye / distance;
    let side = normalize(cross(frame.up.xyz + vec3(0.013, 0.007, 0.0), forward));
    let corner = vec2(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let outline = ball.w * distance / sqrt(distance * distance - ball.w * ball.w);
    let reach = outline + pixel_at(ball.xyz);
    let position = ball.xyz + reach * (corner.x * side + corner.y * cross(forward, side));
    return Corner(frame.clip_from_maze * vec4(position, 1.0), position);
}

// Where a ray from the eye meets the ball; rays that just miss it show its outline.
fn met(ball: vec4<f32>, ray: vec3<f32>) -> Met {
    let from_ball = frame.eye.xyz - ball.xyz;
    let nearest = -dot(from_ball, ray);
    let miss2 = dot(from_ball, from_ball) - nearest * nearest;
    let cover = clamp((ball.w - sqrt(max(miss2, 0.0))) / pixel_at(ball.xyz) + 0.5, 0.0, 1.0);
    return Met(frame.eye.xyz + ray * (nearest - sqrt(max(ball.w * ball.w - miss2, 0.0))), cover);
}

