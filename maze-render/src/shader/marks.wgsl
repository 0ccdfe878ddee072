// Start and goal, let into the floor.

// Half the side of a square that holds a mark and its halo, in radii.
const MARK_REACH = 2.2;

// 1 where low < d < high, smooth over a pixel.
fn band(d: f32, low: f32, high: f32, pixel: f32) -> f32 {
    return smoothstep(low - pixel, low + pixel, d) * (1.0 - smoothstep(high - pixel, high + pixel, d));
}

struct Paint {
    colour: vec3<f32>,
    cover: f32,
    shine: vec3<f32>,
}

// A ring and a dot in blue: here it began.
fn start_mark(p: vec2<f32>, pixel: f32) -> Paint {
    let radius = frame.start.z;
    let d = distance(p, frame.start.xy) / max(radius, 1e-3);
    let px = pixel / max(radius, 1e-3);
    let cover = max(band(d, 0.84, 1.0, px), 1.0 - smoothstep(0.22 - px, 0.22 + px, d));
    return Paint(vec3(0.045, 0.22, 0.60), select(0.0, cover, 0.0 < radius), vec3(0.0));
}

// A target in gold and green: there it ends.
fn goal_mark(p: vec2<f32>, pixel: f32) -> Paint {
    let radius = frame.goal.z;
    let d = distance(p, frame.goal.xy) / max(radius, 1e-3);
    let px = pixel / max(radius, 1e-3);
    let glow = frame.goal.w;
    let gold = max(band(d, 0.82, 1.0, px), 1.0 - smoothstep(0.26 - px, 0.26 + px, d));
    let green = 1.0 - smoothstep(0.82 - px, 0.82 + px, d);
    let dark = band(d, 0.26, 0.42, px) + band(d, 0.62, 0.82, px);
    let greens = mix(vec3(0.05, 0.36, 0.10), vec3(0.015, 0.13, 0.05), clamp(dark, 0.0, 1.0));
    let colour = mix(greens, vec3(0.85, 0.52, 0.10), gold);
    let halo = exp(-2.2 * max(d - 1.0, 0.0)) * select(0.0, 1.0, 0.82 < d);
    let shine = glow * (0.55 * colour * max(gold, green) + 0.10 * vec3(0.75, 0.85, 0.20) * halo);
    return Paint(colour, select(0.0, max(gold, green), 0.0 < radius), select(vec3(0.0), shine, 0.0 < radius));
}

