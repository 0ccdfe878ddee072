// A table under the board: a pool of light in the middle, dark towards the edges, with the board's shadow on it.

// Its light changes slowly: it is computed at the corners of a grid.

const CELLS = vec2(24u, 14u);

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec3<f32>,
}

// Signed distance from the board's outline, along the floor.
fn from_board(p: vec2<f32>) -> f32 {
    let middle = 0.5 * (frame.board.xy + frame.board.zw);
    let half_size = 0.5 * (frame.board.zw - frame.board.xy);
    let d = abs(p - middle) - half_size;
    return length(max(d, vec2(0.0))) + min(max(d.x, d.y), 0.0);
}

// Jimenez' interleaved gradient noise: breaks up the bands of a dark gradient.
fn noise(pixel: vec2<f32>) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715))));
}

fn table_light(screen: vec2<f32>) -> vec3<f32> {
    let far = frame.maze_from_clip * vec4(screen, 1.0, 1.0);
    let ray = normalize(far.xyz / far.w - frame.eye.xyz);
    let drop = frame.up.w;
    let height = dot(frame.eye.xyz, frame.up.xyz) + drop;
    let descent = max(-dot(ray, frame.up.xyz), 0.05);
    let table = frame.eye.xyz + ray * (height / descent);

    // Lit from the sun's side: the pool lies off the middle.
    let pool = exp(-1.1 * dot(screen - vec2(-0.25, 0.3), screen - vec2(-0.25, 0.3)));
    var light = mix(vec3(0.016, 0.021, 0.027), vec3(0.150, 0.172, 0.188), pool);

    // The sun's shadow: where the ray to the sun meets the board's plane. Softer the further it fell.
    let shaded = table.xy - frame.sun.xy * (table.z / frame.sun.z);
    light *= 1.0 - 0.62 * smoothstep(0.45 * drop, -0.45 * drop, from_board(shaded));
    // The sky's: right below.
    light *= 1.0 - 0.38 * smoothstep(1.1 * drop, -0.9 * drop, from_board(table.xy));

    return light;
}

// Corners in rows.
@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    let place = vec2(index % (CELLS.x + 1u), index / (CELLS.x + 1u));
    let screen = vec2<f32>(place) / vec2<f32>(CELLS) * 2.0 - 1.0;
    return Corner(vec4(screen, 1.0, 1.0), picture(table_light(screen)).rgb);
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let step = (noise(in.clip.xy) - 0.5) / 255.0;
    if encode_srgb {
        return vec4(in.colour + step, 1.0);
    }
    // As large a step where the target makes sRGB of it.
    return vec4(in.colour + step * (0.24 + 1.2 * sqrt(in.colour)), 1.0);
}
