// Walls, tops, floor and rim.

// How strong the normal map is.
const RELIEF = 0.9;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) uv: vec2<f32>,
}

@vertex
fn vertex(in: Vertex) -> Corner {
    return Corner(frame.clip_from_maze * vec4(in.position, 1.0), in.position, in.normal, surface_uv(in.uv));
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let bias = select(0.0, wall_bias, kind == WALL);
    let texel = textureSampleBias(surface_texture, surface_sampler, in.uv, bias).rgb;
    let pixel = 0.7 * length(fwidth(in.position.xy)) + 1e-5;
    let p = in.position;
    let v = normalize(frame.eye.xyz - p);
    let face = normalize(in.normal);
    // The texture's axes in the maze: walls run along x or y and up, the rest along x and y.
    let is_upright = abs(face.z) < 0.5;
    let across = select(vec3(1.0, 0.0, 0.0), vec3(abs(face.y), abs(face.x), 0.0), is_upright);
    let down = select(vec3(0.0, -1.0, 0.0), vec3(0.0, 0.0, -1.0), is_upright);
    let lean = textureSampleBias(relief_texture, surface_sampler, in.uv, bias).rg * 2.0 - 1.0;
    var n = normalize(face - RELIEF * (across * lean.x + down * lean.y));
    var finish = Finish(texel, material.roughness, vec3(material.reflectance), 1.0);
    var shine = vec3(0.0);
    var lit_at = p;

    switch kind {
        case WALL: {
            // Dark at the foot, and more so in narrow places; look just outside the wall.
            let crowd = walls_at(p.xy + n.xy * 0.12).x;
            let foot = wall_foot(p);
            finish.occlusion = 1.0 - clamp((0.15 + 0.9 * crowd) * foot, 0.0, 0.6);
            finish.colour *= wall_tint(foot);
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
            finish.occlusion = sky_over_floor(p.xy);
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
            finish.colour *= RIM_TINT;
            finish.occlusion = rim_occlusion(p);
            lit_at = vec3(p.xy, 0.001); // The rim has no shadow of its own: the light at its upper edge.
        }
    }
    finish.occlusion *= sky_past_ball(p, n);
    let sunlight = sun_over_walls(lit_at, face) * sun_past_ball(p);
    return picture(lit(p, n, v, finish, sunlight) + shine);
}
