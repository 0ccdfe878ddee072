// A steel ball: polished and satin fields in turn, grooves between them, inlays of brass and blued steel on the six
// corners where they meet. Every turn shows.

// Set where textures are in sRGB and not decoded.
override is_plain: bool = false;

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    return corner_around(frame.ball, index);
}

// -1 to 1 across an edge, smooth over a pixel.
fn sided(d: f32, pixel: f32) -> f32 {
    return clamp(d / pixel, -1.0, 1.0);
}

// What the polished steel shows in direction r from p: sky, a window of soft light beside the sun, walls near by, and the
// floor where r meets it.
fn mirrored_room(p: vec3<f32>, r: vec3<f32>) -> vec3<f32> {
    let side = normalize(cross(frame.up.xyz, frame.sun.xyz));
    let along = normalize(cross(frame.sun.xyz, side));
    let w = vec2(dot(r, side), dot(r, along)) / max(dot(r, frame.sun.xyz), 1e-3);
    let pane = smoothstep(0.42, 0.34, abs(w.x)) * smoothstep(0.42, 0.34, abs(w.y));
    let in_front = select(0.0, 1.0, 0.0 < dot(r, frame.sun.xyz));
    var light = sky(r) + vec3(1.5, 1.4, 1.25) * pane * in_front;

    let reach = max(p.z, 0.0) / max(-r.z, 0.02);
    let hit = p.xy + r.xy * min(reach, 6.0);
    let texel = textureSampleLevel(surface_texture, surface_sampler, surface_uv(hit), 3.5).rgb;
    // A texture that is not decoded when sampled: sRGB is close to a power of 2.2.
    let wood = select(texel, pow(texel, vec3(2.2)), is_plain);
    let sunlit = sun_over_walls(vec3(hit, 0.01), vec3(0.0, 0.0, 1.0)) * max(frame.sun.z, 0.0);
    let floor_seen = wood * (SUN_LIGHT * sunlit / 2.2 + SKY_LIGHT * sky_over_floor(hit));
    light = mix(light, floor_seen, smoothstep(0.02, -0.10, r.z));

    // The nearest wall on the ray, found in a few steps.
    for (var i = 4; 1 <= i; i--) {
        let q = p + r * (0.22 * f32(i));
        let inside = smoothstep(0.4, 0.6, walls_at(q.xy).y) * smoothstep(frame.sky.w, frame.sky.w - 0.08, q.z);
        let brick = vec3(0.30, 0.12, 0.07) * (0.25 + 0.75 * clamp(q.z / max(frame.sky.w, 0.1), 0.0, 1.0));
        light = mix(light, brick, inside * smoothstep(-0.05, 0.05, q.z));
    }
    return light;
}

@fragment
fn fragment(in: Corner) -> Seen {
    let ray = normalize(in.position - frame.eye.xyz);
    let met = met(frame.ball, ray);
    if met.cover <= 0.0 {
        discard;
    }
    let radius = frame.ball.w;
    let p = met.position;
    let n = normalize(p - frame.ball.xyz);
    let v = -ray;
    let nv = max(dot(n, v), 0.0);
    let q = vec4(-frame.ball_rotation.xyz, frame.ball_rotation.w);
    let b = n + 2.0 * cross(q.xyz, cross(q.xyz, n) + q.w * n);
    let pixel = 0.75 * pixel_at(p) / (radius * max(nv, 0.25));

    // Fields: the sign of x y z. Grooves: the three great circles. Inlays: around the six axes' ends.
    let fields = 0.5 + 0.5 * sided(b.x, pixel) * sided(b.y, pixel) * sided(b.z, pixel);
    let a = abs(b);
    let nearest_groove = min(a.x, min(a.y, a.z));
    let from_axis = acos(clamp(max(a.x, max(a.y, a.z)), 0.0, 1.0));
    let inlay = 1.0 - smoothstep(0.30 - pixel, 0.30 + pixel, from_axis);
    let rim = inlay * smoothstep(0.25 - pixel, 0.25 + pixel, from_axis);
    let groove = max((1.0 - smoothstep(0.022 - pixel, 0.022 + pixel, nearest_groove)) * (1.0 - inlay), rim);
    // The inlays on one axis are blued steel, on the other two brass: no two turns look the same.
    let is_blue = select(0.0, 1.0, a.z < max(a.x, a.y) && a.y < a.x);

    let steel = vec3(0.68, 0.69, 0.71);
    let metal = mix(steel, mix(vec3(0.91, 0.66, 0.27), vec3(0.10, 0.17, 0.42), is_blue), inlay);
    let satin = (1.0 - fields) * (1.0 - inlay);
    let f0 = metal * (1.0 - 0.75 * groove);
    let roughness = mix(0.16, 0.42, satin);

    let crowd = walls_at(p.xy).x;
    let openness = 1.0 - clamp(1.2 * crowd, 0.0, 0.6);
    // The floor takes the sky from the ball's lower half.
    let occlusion = mix(0.35, 1.0, smoothstep(-1.0, 0.5, n.z)) * mix(openness, 1.0, smoothstep(0.0, 0.9, n.z));
    let sunlight = sun_over_walls(p, n);
    let r = reflect(-v, n);
    // Satin scatters: what it shows is the mean of much of the room.
    let scattered = 0.62 * (ambient(n) + SUN_LIGHT * (max(dot(n, frame.sun.xyz), 0.0) * sunlight / 2.8)) * occlusion;
    let polished = mirrored_room(p, r) * mix(0.75, 1.0, occlusion);
    let seen = mix(polished, scattered, 0.9 * satin) * fresnel(f0, nv);
    let sun_glint = min(glint(n, v, roughness, f0) * SUN_LIGHT * sunlight, vec3(4.0));
    let clip = frame.clip_from_maze * vec4(p, 1.0);
    return Seen(vec4(picture(seen + sun_glint).rgb, met.cover), clip.z / clip.w);
}
