// From light to the picture's colours.

// Set where the target's format does not do it.
override encode_srgb: bool = false;

fn to_srgb(linear: vec3<f32>) -> vec3<f32> {
    let low = 12.92 * linear;
    let high = 1.055 * pow(max(linear, vec3(0.0)), vec3(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3(0.0031308));
}

// Khronos PBR Neutral: leaves colours below 0.76 as they are, bends highlights gently towards white.
// https://github.com/KhronosGroup/ToneMapping/tree/main/PBR_Neutral
fn tonemapped(light: vec3<f32>) -> vec3<f32> {
    let start = 0.76;
    let low = min(light.r, min(light.g, light.b));
    let offset = select(0.04, low - 6.25 * low * low, low < 0.08);
    let colour = light - offset;
    let peak = max(colour.r, max(colour.g, colour.b));
    if peak < start {
        return colour;
    }
    let room = 1.0 - start;
    let new_peak = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (0.15 * (peak - new_peak) + 1.0);
    return mix(colour * new_peak / peak, vec3(new_peak), white);
}

fn picture(light: vec3<f32>) -> vec4<f32> {
    let colour = clamp(tonemapped(light), vec3(0.0), vec3(1.0));
    if encode_srgb {
        return vec4(to_srgb(colour), 1.0);
    }
    return vec4(colour, 1.0);
}


// For colours that are in sRGB already.
fn from_encoded(colour: vec3<f32>) -> vec3<f32> {
    if encode_srgb {
        return colour;
    }
    let c = clamp(colour, vec3(0.0), vec3(1.0));
    return select(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, c <= vec3(0.04045));
}
