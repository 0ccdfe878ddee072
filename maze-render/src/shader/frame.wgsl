// What every shader knows about a frame. All positions and directions are in the maze frame.

struct Frame {
    clip_from_maze: mat4x4<f32>,
    maze_from_clip: mat4x4<f32>,
    sun_clip_from_maze: mat4x4<f32>,
    eye: vec4<f32>,           // position; two over the picture's width
    sun: vec4<f32>,           // unit, towards the sun; two over the picture's height
    up: vec4<f32>,            // unit, up in the world; depth of the table below the origin
    sky: vec4<f32>,           // unit, towards the brightest sky; height of the walls
    ball: vec4<f32>,          // centre; radius
    ball_rotation: vec4<f32>, // quaternion, maze from ball
    start: vec4<f32>,         // x, y; radius; unused
    goal: vec4<f32>,          // x, y; radius; glow
    board: vec4<f32>,         // smallest x, y; largest x, y
    occlusion: vec4<f32>,     // occlusion map from maze x, y: scale; offset
    shadow: vec4<f32>,        // blur in the shadow map x, y; distance to step off a surface; width of a soft edge in the floor's light
    floor: vec4<f32>,         // the floor's mean colour, linear; unused
    ghost: vec4<f32>,         // centre; radius
}

@group(0) @binding(0) var<uniform> frame: Frame;


// Width of a pixel at p, across the line of sight (maze units).
fn pixel_at(p: vec3<f32>) -> f32 {
    let m = frame.clip_from_maze;
    let depth = dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(p, 1.0));
    return frame.eye.w * depth / length(vec3(m[0].x, m[1].x, m[2].x));
}
