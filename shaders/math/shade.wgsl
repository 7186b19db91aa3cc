#import math/real

// What lighting and silhouettes make of a segment (src/scene/optics.rs has the formulas). Gradients are relative to the
// mesh's largest magnitude, in view axes: x to the right, y up, z away from the eye. `ray`: x/z and y/z of its direction.
// No result is NaN or infinite.

// x^p for x in [0, 1] and p > 0; 0 where x is below 1e-30. Absolute error 2e-7.
fn power(x: real, p: real) -> real {
    if !(x > 1e-30) {
        return 0.0;
    }
    // Devices' logarithms may err by 2^-21 absolute near 1, which large p bring forth: a series there.
    var logarithm = log2(x);
    if x > 0.7 {
        let u = (x - 1.0) / (x + 1.0);
        let q = u * u;
        logarithm = 2.8853900817779268 * u * (1.0 + q * (0.3333333333333333 + q * (0.2 + q * (0.14285714285714285
            + q * 0.1111111111111111))));
    }
    return exp2(max(p * logarithm, -125.0));
}

// How much lighting and silhouettes count: 0 where the gradient vanishes, and 1/2 at a thousandth of the largest.
fn fade(gradient: real3) -> real {
    let squared = dot(gradient, gradient);
    return squared / (squared + 1e-6);
}

// The unit normal; shorter where nothing counts.
fn normal_of(gradient: real3) -> real3 {
    return gradient / max(length(gradient), 1e-18);
}

// Two-sided Blinn-Phong: the factor on colours, and the white that is added to them. `light`: towards it, unit length, and
// the ambient part; `material`: diffuse, specular, shininess. The half vector has a length also where light and eye lie
// on opposite sides. Absolute error of the factor 1.4e-7, of the white 1e-7 times the shininess.
fn lit(gradient: real3, ray: real2, light: real4, material: real3) -> real2 {
    let weight = fade(gradient);
    let normal = normal_of(gradient);
    let half_way = light.xyz - normalize(real3(ray, 1.0));
    let glance = abs(dot(normal, half_way)) / length(real4(half_way, 1e-3));
    let brightness = light.w + material.x * abs(dot(normal, light.xyz));
    return real2(1.0 + weight * (brightness - 1.0), weight * material.y * power(min(glance, 1.0), material.z));
}

// The silhouette's factor: 1 where the surface is seen edge-on, down to 1 - strength where it faces the eye. Absolute error
// 3e-7 times the exponent.
fn outlined(gradient: real3, ray: real2, exponent: real, strength: real) -> real {
    let normal = normal_of(gradient);
    let direction = normalize(real3(ray, 1.0));
    // 1 - |cos| without its cancellation: sin^2 / (1 + |cos|).
    let sine = cross(normal, direction);
    let turned_away = dot(sine, sine) / (1.0 + abs(dot(normal, direction)));
    return 1.0 + fade(gradient) * strength * (power(min(turned_away, 1.0), exponent) - 1.0);
}
