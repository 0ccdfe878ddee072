// A lacquered ball: eight fields in ivory and cobalt, gold let into the seams, a gold-rimmed cap on each of the six
// corners where they meet. Every turn shows.

// Set where a pixel has one sample.
override fades_out: bool = false;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) on_ball: vec3<f32>,
}

@vertex
fn vertex(@location(0) on_ball: vec3<f32>) -> Corner {
    let q = frame.ball_rotation;
    let turned = on_ball + 2.0 * cross(q.xyz, cross(q.xyz, on_ball) + q.w * on_ball);
    let position = frame.ball.xyz + frame.ball.w * turned;
    return Corner(frame.clip_from_maze * vec4(position, 1.0), position, on_ball);
}

// -1 to 1 across an edge, smooth over a pixel.
fn sided(d: f32, pixel: f32) -> f32 {
    return clamp(d / pixel, -1.0, 1.0);
}

@fragment
fn fragment(in: Corner) -> @location(0) vec4<f32> {
    let b = normalize(in.on_ball);
    let pixel = max(0.75 * length(fwidth(in.on_ball)), 1e-4);
    let n = normalize(in.position - frame.ball.xyz);
    let p = in.position;
    let v = normalize(frame.eye.xyz - p);

    // Fields: the sign of x y z. Seams: the three great circles. Caps: around the six axes' ends.
    let fields = 0.5 + 0.5 * sided(b.x, pixel) * sided(b.y, pixel) * sided(b.z, pixel);
    let a = abs(b);
    let nearest_seam = min(a.x, min(a.y, a.z));
    let from_axis = acos(clamp(max(a.x, max(a.y, a.z)), 0.0, 1.0));
    let seam = 1.0 - smoothstep(0.035 - pixel, 0.035 + pixel, nearest_seam);
    let cap = 1.0 - smoothstep(0.27 - pixel, 0.27 + pixel, from_axis);
    let cap_rim = cap * smoothstep(0.20 - pixel, 0.20 + pixel, from_axis);
    // The caps on one axis are dark, on the other two light: no two turns look the same.
    let is_dark_cap = select(0.0, 1.0, a.z < max(a.x, a.y) && a.y < a.x);
    let ivory = vec3(0.86, 0.80, 0.68);
    let cobalt = vec3(0.018, 0.075, 0.33);
    var colour = mix(cobalt, ivory, fields);
    colour = mix(colour, mix(ivory, cobalt, is_dark_cap), cap);
    let gold = clamp(max(seam * (1.0 - cap), cap_rim), 0.0, 1.0);
    colour = mix(colour, vec3(0.25, 0.15, 0.04), gold);
    let f0 = mix(vec3(0.05), vec3(0.95, 0.68, 0.28), gold);
    let roughness = mix(0.16, 0.28, gold);

    let crowd = walls_at(p.xy).x;
    let openness = 1.0 - clamp(1.2 * crowd, 0.0, 0.6);
    // The floor takes the sky from the ball's lower half.
    let occlusion = mix(0.35, 1.0, smoothstep(-1.0, 0.5, n.z)) * mix(openness, 1.0, smoothstep(0.0, 0.9, n.z));
    let finish = Finish(colour, roughness, f0, occlusion);
    let sunlight = sun_over_walls(p, n);
    let nl = max(dot(n, frame.sun.xyz), 0.0);
    let diffuse = colour * (SUN_LIGHT * (nl * sunlight) / 2.2 + ambient(n) * occlusion) * (1.0 - 0.8 * gold);

    // The room in the lacquer: sky above, the wooden floor below, walls where the way to the floor ends in one.
    let r = reflect(-v, n);
    let below = smoothstep(0.05, -0.12, r.z);
    let reach = (frame.ball.z - frame.ball.w - p.z) / min(r.z, -0.08);
    let hit = p.xy + r.xy * max(reach, 0.0);
    let floor_light = frame.floor.rgb * 0.85 * (1.0 - clamp(1.5 * walls_at(hit).x, 0.0, 0.8));
    var room = mix(sky(r), floor_light, below);
    // A window of soft light, seen beside the sun's glint.
    let side = normalize(cross(frame.up.xyz, frame.sun.xyz));
    let along = normalize(cross(frame.sun.xyz, side));
    let w = vec2(dot(r, side), dot(r, along)) / max(dot(r, frame.sun.xyz), 1e-3);
    let pane = smoothstep(0.42, 0.34, abs(w.x)) * smoothstep(0.42, 0.34, abs(w.y));
    let lit_side = select(0.0, 1.0, 0.0 < dot(r, frame.sun.xyz));
    room += vec3(1.5, 1.4, 1.25) * pane * lit_side;
    let mirrored = room * fresnel(f0, max(dot(n, v), 0.0)) * mix(0.6, 1.0, openness);
    let sun_glint = min(glint(n, v, roughness, f0) * SUN_LIGHT * sunlight, vec3(3.0));
    var colour_out = picture(diffuse + mirrored + sun_glint);
    if fades_out {
        // The outline lies where n turns away; a part of the radius farther in there are nv^2 / 2 of it left.
        let nv = max(dot(n, v), 0.0);
        colour_out.a = clamp(0.5 * nv * nv * frame.ball.w / max(pixel_at(p), 1e-5), 0.0, 1.0);
    }
    return colour_out;
}
