// Another engine's ball: tinted glass, clear in the middle and dense at the outline.

const TINT: vec3<f32> = vec3(0.02, 0.50, 0.75);
// How much it covers in its middle and at its outline.
const DENSITY: vec2<f32> = vec2(0.40, 0.95);

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Corner {
    return corner_around(frame.ghost, index);
}

@fragment
fn fragment(in: Corner) -> Seen {
    let ray = normalize(in.position - frame.eye.xyz);
    let met = met(frame.ghost, ray);
    if met.cover <= 0.0 {
        discard;
    }
    let n = normalize(met.position - frame.ghost.xyz);
    let rim = pow(1.0 - max(dot(n, -ray), 0.0), 2.0);
    let light = TINT * (0.6 + 0.4 * dot(n, frame.up.xyz));
    let clip = frame.clip_from_maze * vec4(met.position, 1.0);
    return Seen(vec4(picture(light).rgb, met.cover * mix(DENSITY.x, DENSITY.y, rim)), clip.z / clip.w);
}
