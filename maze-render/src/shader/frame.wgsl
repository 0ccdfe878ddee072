// What every shader knows about a frame. All positions and directions are in the maze frame.

struct Frame {
    clip_from_maze: mat4x4<f32>,
    maze_from_clip: mat4x4<f32>,
    sun_clip_from_maze: mat4x4<f32>,
    eye: vec4<f32>,           // position; unused
    sun: vec4<f32>,           // unit, towards the sun; unused
    up: vec4<f32>,            // unit, up in the world; depth of the table below the origin
    sky: vec4<f32>,           // unit, towards the brightest sky; height of the walls
    ball: vec4<f32>,          // centre; radius
    ball_rotation: vec4<f32>, // quaternion, maze from ball
    start: vec4<f32>,         // x, y; radius; unused
    goal: vec4<f32>,          // x, y; radius; glow
    board: vec4<f32>,         // smallest x, y; largest x, y
    occlusion: vec4<f32>,     // occlusion map from maze x, y: scale; offset
    shadow: vec4<f32>,        // blur in the sun's map x, y; distance to step off a surface; unused
    floor: vec4<f32>,         // the floor's mean colour, linear; unused
}

@group(0) @binding(0) var<uniform> frame: Frame;

