// The maze in few operations a pixel. A texture's bytes are taken as they are, in sRGB, and multiplied by a shade that
// was computed for the texture's mean colour at the triangle's corners: exact there, close elsewhere.

// What a surface of the texture's mean colour shows, over that colour.
fn shade(p: vec3<f32>, n: vec3<f32>, tint: f32, occlusion: f32, sunlight: f32) -> vec3<f32> {
    let v = normalize(frame.eye.xyz - p);
    let mean = material.mean.rgb;
    let finish = Finish(mean * tint, material.roughness, vec3(material.reflectance), occlusion);
    return to_srgb(tonemapped(without_glint(n, v, finish, sunlight))) / to_srgb(max(mean, vec3(0.001)));
}

fn shown(colour: vec3<f32>) -> vec4<f32> {
    return vec4(from_encoded(colour), 1.0);
}

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) shade: vec3<f32>,
}

@vertex
fn vertex(in: Vertex) -> Corner {
    let p = in.position;
    var tint = 1.0;
    var occlusion = 1.0;
    if kind == WALL {
        let foot = wall_foot(p);
        tint = wall_tint(foot);
        occlusion = 1.0 - 0.45 * foot;
    }
    if kind == RIM {
        tint = RIM_TINT;
        occlusion = rim_occlusion(p);
    }
    let shade = shade(p, in.normal, tint, occlusion, 1.0);
    return Corner(frame.clip_from_maze * vec4(p, 1.0), surface_uv(in.uv), shade);
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let bias = select(0.0, wall_bias, kind == WALL);
    return shown(textureSampleBias(surface_texture, surface_sampler, in.uv, bias).rgb * in.shade);
}

struct FloorCorner {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) map_uv: vec2<f32>,
    @location(2) in_shadow: vec3<f32>,
    @location(3) from_sun: vec3<f32>,
}

@vertex
fn vertex_floor(in: Vertex) -> FloorCorner {
    let p = in.position;
    let in_shadow = shade(p, in.normal, 1.0, 1.0, 0.0);
    let from_sun = shade(p, in.normal, 1.0, 1.0, 1.0) - in_shadow;
    let map_uv = p.xy * frame.occlusion.xy + frame.occlusion.zw;
    return FloorCorner(frame.clip_from_maze * vec4(p, 1.0), surface_uv(in.uv), map_uv, in_shadow, from_sun);
}

@fragment
fn fragment_floor(in: FloorCorner) -> @location(0) vec4<f32> {
    let texel = textureSample(surface_texture, surface_sampler, in.uv).rgb;
    let light = textureSampleLevel(floor_light, occlusion_sampler, in.map_uv, 0.0);
    return shown(texel * (in.in_shadow + in.from_sun * (light.r * light.b)) * (light.g * light.a));
}

// A top's edge, drawn over what lies beside it and fading out within a pixel: smooth without further samples.
struct Edge {
    @builtin(position) clip: vec4<f32>,
    @location(0) uv: vec2<f32>,
    @location(1) shade: vec3<f32>,
    @location(2) cover: f32,
}

// The normal holds the direction out of the top in x and y, and in z 1 at the outer end.
@vertex
fn vertex_edge(in: Vertex) -> Edge {
    let out = vec3(in.normal.xy, 0.0);
    let along = vec3(out.y, -out.x, 0.0);
    let clip = frame.clip_from_maze * vec4(in.position, 1.0);
    let pixel = vec2(frame.eye.w, frame.sun.w);
    let on_screen = clip.xy / clip.w / pixel;
    let out_clip = frame.clip_from_maze * vec4(in.position + 0.1 * out, 1.0);
    let along_clip = frame.clip_from_maze * vec4(in.position + 0.1 * along, 1.0);
    let edge = normalize(along_clip.xy / along_clip.w / pixel - on_screen);
    let across = vec2(edge.y, -edge.x);
    let side = sign(dot(across, out_clip.xy / out_clip.w / pixel - on_screen));
    let moved = clip.xy + across * side * in.normal.z * pixel * clip.w;
    let shade = shade(in.position, vec3(0.0, 0.0, 1.0), 1.0, 1.0, 1.0);
    return Edge(vec4(moved, clip.zw), surface_uv(in.uv), shade, 1.0 - in.normal.z);
}

@fragment
fn fragment_edge(in: Edge) -> @location(0) vec4<f32> {
    let colour = textureSample(surface_texture, surface_sampler, in.uv).rgb * in.shade;
    return vec4(from_encoded(colour), in.cover);
}

// Start and goal: a square each, a little above the floor.
struct Mark {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
}

@vertex
fn vertex_mark(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Mark {
    let mark = select(frame.goal, frame.start, instance == 0u);
    let corner = vec2(f32(index & 1u), f32(index >> 1u)) * 2.0 - 1.0;
    let p = vec3(mark.xy + corner * MARK_REACH * mark.z, 0.0);
    var clip = frame.clip_from_maze * vec4(p, 1.0);
    clip.z -= 1e-4 * clip.w;
    return Mark(clip, p);
}

@fragment
fn fragment_mark(in: Mark) -> @location(0) vec4<f32> {
    let pixel = 0.7 * length(fwidth(in.position.xy)) + 1e-5;
    let p = in.position;
    let uv = p.xy * frame.occlusion.xy + frame.occlusion.zw;
    let light = textureSampleLevel(floor_light, occlusion_sampler, uv, 0.0);
    let start = start_mark(p.xy, pixel);
    let goal = goal_mark(p.xy, pixel);
    let colour = mix(start.colour, goal.colour, goal.cover);
    let sky = light.g * light.a;
    let finish = Finish(colour, 0.3, vec3(material.reflectance), sky * sky);
    let v = normalize(frame.eye.xyz - p);
    let seen = without_glint(vec3(0.0, 0.0, 1.0), v, finish, light.r * light.b) + goal.shine;
    // The halo only adds: it covers as much as it is bright.
    let cover = max(max(start.cover, goal.cover), clamp(2.0 * goal.shine.g, 0.0, 0.6));
    return vec4(from_encoded(to_srgb(tonemapped(seen))), cover);
}
