// One sun with shadows, and a sky.

@group(1) @binding(0) var sun_map: texture_depth_2d;
@group(1) @binding(1) var sun_sampler: sampler_comparison;
@group(1) @binding(2) var occlusion_map: texture_2d<f32>;
@group(1) @binding(3) var occlusion_sampler: sampler;
@group(1) @binding(4) var floor_light: texture_2d<f32>;

// PCF taps of the shadow map along each side of a soft edge; with none, the map of the floor's light is sampled instead.
override pcf_taps: i32 = 3;

const PI = 3.14159265;
const SUN_LIGHT = vec3(2.45, 2.22, 1.92);
const SKY_LIGHT = vec3(0.46, 0.50, 0.57);
const GROUND_LIGHT = vec3(0.16, 0.14, 0.13);

// What a mirror shows in direction d: a bright sky over a dark room.
fn sky(d: vec3<f32>) -> vec3<f32> {
    let height = dot(d, frame.up.xyz);
    let horizon = mix(vec3(0.20, 0.19, 0.19), vec3(0.62, 0.66, 0.72), smoothstep(-0.1, 0.55, height));
    return mix(horizon, vec3(0.80, 0.86, 0.95), smoothstep(0.4, 1.0, height));
}

// From the sky and the dark room below it, and back from the sunlit floor: that is what lights the walls' near sides.
fn ambient(n: vec3<f32>) -> vec3<f32> {
    let from_floor = frame.floor.rgb * SUN_LIGHT * (0.42 * max(frame.sun.z, 0.0) * (0.5 - 0.5 * n.z));
    return mix(GROUND_LIGHT, SKY_LIGHT, 0.5 + 0.5 * dot(n, frame.sky.xyz)) + from_floor;
}

// x: how much the walls around crowd out the sky; y: 1 well inside a wall's top, one half on its edge.
fn walls_at(p: vec2<f32>) -> vec2<f32> {
    return textureSampleLevel(occlusion_map, occlusion_sampler, p * frame.occlusion.xy + frame.occlusion.zw, 0.0).rg;
}

// 1 in the sun, 0 behind a wall: a square of PCF taps of the shadow map, heavier in the middle, each the mean of four texels.
fn sun_over_walls(p: vec3<f32>, n: vec3<f32>) -> f32 {
    if pcf_taps == 0 {
        let floor = p.xy - frame.sun.xy * (p.z / max(frame.sun.z, 0.1));
        return textureSampleLevel(floor_light, occlusion_sampler, floor * frame.occlusion.xy + frame.occlusion.zw, 0.0).r;
    }
    let clip = frame.sun_clip_from_maze * vec4(p + n * frame.shadow.z, 1.0);
    let uv = vec2(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y);
    let last = 0.5 * f32(pcf_taps - 1);
    var sum = 0.0;
    var whole = 0.0;
    for (var i = 0; i < pcf_taps; i++) {
        for (var j = 0; j < pcf_taps; j++) {
            let offset = vec2(f32(i), f32(j)) - last;
            let weight = (last + 1.0 - abs(offset.x)) * (last + 1.0 - abs(offset.y));
            sum += weight * textureSampleCompareLevel(sun_map, sun_sampler, uv + offset * frame.shadow.xy, clip.z);
            whole += weight;
        }
    }
    return sum / whole;
}

// The ball's shadow: soft where the light has gone far past it.
fn sun_past_ball(p: vec3<f32>) -> f32 {
    let to_ball = frame.ball.xyz - p;
    let along = dot(to_ball, frame.sun.xyz);
    let gap = length(to_ball - frame.sun.xyz * along) - frame.ball.w;
    let softness = 0.02 + 0.13 * max(along, 0.0);
    return select(1.0, smoothstep(-softness, softness, gap), 0.0 < along && 0.0 < frame.ball.w);
}

// The part of the sky above a surface that the ball leaves free (Quilez, sphere ambient occlusion).
fn sky_past_ball(p: vec3<f32>, n: vec3<f32>) -> f32 {
    let to_ball = frame.ball.xyz - p;
    let d2 = max(dot(to_ball, to_ball), 1e-6);
    let cosine = dot(n, to_ball) * inverseSqrt(d2);
    let r = max(frame.ball.w, 0.0);
    return 1.0 - clamp(cosine, 0.0, 1.0) * min(r * r / d2, 1.0);
}

fn fresnel(f0: vec3<f32>, cosine: f32) -> vec3<f32> {
    let c = clamp(1.0 - cosine, 0.0, 1.0);
    let c2 = c * c;
    return f0 + (1.0 - f0) * (c2 * c2 * c);
}

// Trowbridge-Reitz lobe with Hammon's approximate visibility, times the cosine.
fn glint(n: vec3<f32>, v: vec3<f32>, roughness: f32, f0: vec3<f32>) -> vec3<f32> {
    let l = frame.sun.xyz;
    let h = normalize(l + v);
    let nl = max(dot(n, l), 0.0);
    let nv = max(dot(n, v), 1e-3);
    let nh = max(dot(n, h), 0.0);
    let a = roughness * roughness;
    let d = nh * nh * (a * a - 1.0) + 1.0;
    let lobe = a * a / (PI * d * d);
    let visibility = 0.5 / mix(2.0 * nl * nv, nl + nv, a);
    return fresnel(f0, dot(h, v)) * (lobe * visibility * nl);
}

struct Finish {
    colour: vec3<f32>,
    roughness: f32,
    f0: vec3<f32>,
    occlusion: f32, // the sky's part that reaches the surface
}

fn without_glint(n: vec3<f32>, v: vec3<f32>, finish: Finish, sunlight: f32) -> vec3<f32> {
    let nl = max(dot(n, frame.sun.xyz), 0.0);
    let diffuse = finish.colour * (SUN_LIGHT * (nl * sunlight) / 2.2 + ambient(n) * finish.occlusion);
    let mirrored = sky(reflect(-v, n)) * fresnel(finish.f0, dot(n, v)) * (1.0 - finish.roughness) * finish.occlusion;
    return diffuse + mirrored;
}

fn lit(p: vec3<f32>, n: vec3<f32>, v: vec3<f32>, finish: Finish, sunlight: f32) -> vec3<f32> {
    let mirrored_sun = glint(n, v, finish.roughness, finish.f0) * SUN_LIGHT * sunlight;
    return without_glint(n, v, finish, sunlight) + mirrored_sun;
}


// The sky's part that the walls leave to the floor.
fn sky_over_floor(p: vec2<f32>) -> f32 {
    return 1.0 - clamp(1.35 * walls_at(p).x, 0.0, 0.8);
}

// 1 at a wall's foot, 0 at its top.
fn wall_foot(p: vec3<f32>) -> f32 {
    return 1.0 - clamp(p.z / max(frame.sky.w, 1e-3), 0.0, 1.0);
}

// Grime where the floor meets the wall.
fn wall_tint(foot: f32) -> f32 {
    return 1.25 - 0.4 * foot * foot * foot;
}

const RIM_TINT = 0.62;

fn rim_occlusion(p: vec3<f32>) -> f32 {
    return 0.55 + 0.45 * smoothstep(-0.4, 0.0, p.z);
}
