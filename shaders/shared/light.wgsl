#import math/shade

// Lighting and silhouettes: factors that are constant over a cell's segment, from the gradient in its middle.

struct Light {
    // Towards the light, unit length; view axes (z away from the eye).
    direction: vec3f,
    ambient: f32,
    diffuse: f32,
    specular: f32,
    shininess: f32,
    // Of silhouettes.
    strength: f32,
    exponent: f32,
    pad_a: f32,
    pad_b: f32,
    pad_c: f32,
}

@group(0) @binding(1) var<uniform> light: Light;

// Colours are lit.
override LIT: bool = false;
// What silhouettes multiply: 0 nothing, 1 opacities, 2 densities.
override OUTLINE: u32 = 0u;

struct Factors {
    // On extinction and emission.
    density: f32,
    // On opacity and colour of the whole segment.
    opacity: f32,
    color: f32,
    // White added to every colour.
    white: f32,
}

// `material`: diffuse, specular, shininess, and the silhouettes' strength.
fn factors(gradient: vec3f, ray: vec2f, towards: vec4f, material: vec4f, exponent: f32) -> Factors {
    var f = Factors(1.0, 1.0, 1.0, 0.0);
    if LIT {
        let colors = lit(gradient, ray, towards, material.xyz);
        f.color = colors.x;
        f.white = colors.y;
    }
    if OUTLINE == 1u {
        f.opacity = outlined(gradient, ray, exponent, material.w);
    }
    if OUTLINE == 2u {
        f.density = outlined(gradient, ray, exponent, material.w);
    }
    return f;
}

// The segment's premultiplied colour and transmittance, with all factors but the density, which scaled its length. Of
// weighted emission: what is white everywhere emits its opacity.
fn with_factors(plain: vec4f, f: Factors) -> vec4f {
    let opacity = 1.0 - plain.a;
    return vec4f(f.opacity * (f.color * plain.rgb + f.white * opacity), 1.0 - f.opacity * opacity);
}
