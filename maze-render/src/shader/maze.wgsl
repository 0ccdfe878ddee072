// Walls, tops, floor and rim.

struct Material {
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

@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var surface_texture: texture_2d<f32>;
@group(2) @binding(2) var surface_sampler: sampler;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

@vertex
fn vertex(in: Vertex) -> Corner {
    // Pictures have their first row on top.
    let uv = vec2(in.uv.x, -in.uv.y) * material.repeats_per_unit;
    return Corner(frame.clip_from_maze * vec4(in.position, 1.0), in.position, in.normal, uv);
}

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

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let texel = textureSample(surface_texture, surface_sampler, in.uv).rgb;
    let pixel = 0.7 * length(fwidth(in.position.xy)) + 1e-5;
    let p = in.position;
    let v = normalize(frame.eye.xyz - p);
    var n = normalize(in.normal);
    var finish = Finish(texel, material.roughness, vec3(material.reflectance), 1.0);
    var shine = vec3(0.0);
    var lit_at = p;

    switch kind {
        case WALL: {
            // Dark at the foot, and more so in narrow places; look just outside the wall.
            let crowd = walls_at(p.xy + n.xy * 0.12).x;
            let foot = 1.0 - clamp(p.z / max(frame.sky.w, 1e-3), 0.0, 1.0);
            finish.occlusion = 1.0 - clamp((0.15 + 0.9 * crowd) * foot, 0.0, 0.6);
            // Grime where the floor meets the wall.
            finish.colour *= 1.25 - 0.4 * foot * foot * foot;
        }
        case TOP: {
            // Round the edges: the map falls off across them.
            let e = 0.02;
            let slope = vec2(
                walls_at(p.xy + vec2(e, 0.0)).y - walls_at(p.xy - vec2(e, 0.0)).y,
                walls_at(p.xy + vec2(0.0, e)).y - walls_at(p.xy - vec2(0.0, e)).y,
            );
            n = normalize(n - vec3(slope * 0.9, 0.0));
        }
        case FLOOR: {
            let crowd = walls_at(p.xy).x;
            finish.occlusion = 1.0 - clamp(1.35 * crowd, 0.0, 0.8);
            let start = start_mark(p.xy, pixel);
            let goal = goal_mark(p.xy, pixel);
            // Enamel let into the wood: the grain still shows a little.
            let grain = 0.75 + 0.5 * dot(texel, vec3(0.33));
            finish.colour = mix(finish.colour, start.colour * grain, start.cover);
            finish.colour = mix(finish.colour, goal.colour * grain, goal.cover);
            finish.roughness = mix(finish.roughness, 0.3, max(start.cover, goal.cover));
            shine = goal.shine;
        }
        default: {
            finish.colour *= 0.62;
            finish.occlusion = 0.55 + 0.45 * smoothstep(-0.4, 0.0, p.z);
            lit_at = vec3(p.xy, 0.001); // The rim has no shadow of its own: the light at its upper edge.
        }
    }
    finish.occlusion *= sky_past_ball(p, n);
    let sunlight = sun_over_walls(lit_at, normalize(in.normal)) * sun_past_ball(p);
    return picture(lit(p, n, v, finish, sunlight) + shine);
}
