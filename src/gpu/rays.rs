//! The rays of a picture as shaders see them.

use glam::{DVec2, DVec3};

use crate::gpu::layout;
use crate::plan::lens::Lens;

/// Beyond any mesh.
const FAR: f32 = 1e30;

/// Across rays, units in one of mesh space: as many as let no edge, up to `longest` in mesh units, be longer than 2^24.
///
/// The smaller the cells, the finer the units: rounding to them is the same share of a cell. What f32 holds of places is no
/// finer than 2^-30.
pub fn units_across(longest: f64) -> f32 {
    // What rounding adds to an edge is less than the hundredth.
    let exponent = 24.0 - (1.01 * longest).log2().ceil();
    exponent.clamp(23.0, 30.0).exp2() as f32
}

/// What `shared/ray.wgsl` reads. `groups`: of linked cells around the eye, how many; `units`: see [`units_across`].
///
/// Everything is counted from the mesh's centre and the ray that passes nearest to it, in f64: neither a far eye nor a
/// picture much larger than the mesh costs digits.
pub fn uniform(
    lens: &Lens,
    size: [u32; 2],
    groups: u32,
    units: f32,
    least_transmittance: f64,
    background: [f32; 4],
) -> layout::Rays {
    let center = lens.view(DVec3::ZERO);
    // Film positions are at depth 1; parallel rays are as far apart everywhere.
    let depth = if lens.perspective { center.z } else { 1.0 };
    let on_film = center.truncate() / depth;
    let nearest = if depth > 0.0 && on_film.is_finite() { lens.pixel(on_film).floor() } else { DVec2::ZERO };
    let pixel = nearest.clamp(DVec2::ZERO, DVec2::new(f64::from(size[0]), f64::from(size[1])));
    let film = lens.film_origin + lens.film_step * (pixel + 0.5);
    let f32s = |v: DVec2| v.as_vec2().to_array();
    layout::Rays {
        right: lens.basis.right.as_vec3().to_array(),
        least_transmittance: least_transmittance as f32,
        up: lens.basis.up.as_vec3().to_array(),
        near: (lens.near - center.z) as f32,
        forward: lens.basis.forward.as_vec3().to_array(),
        groups,
        units,
        film: f32s(film),
        film_step: f32s(lens.film_step),
        start: f32s(center.truncate() - depth * film),
        start_step: f32s(depth * lens.film_step),
        pixel: pixel.as_ivec2().to_array(),
        size,
        background,
        eye: if lens.perspective { -center.z as f32 } else { -FAR },
        ..Default::default()
    }
}

#[cfg(test)]
mod tests {
    use super::units_across;

    #[test]
    fn the_longest_edge_has_2_to_the_24_units_at_most() {
        let (least, most) = (23_f32.exp2(), 30_f32.exp2());
        // The mesh lies within 1 of the origin, so that no edge is longer than 2.
        for (longest, units) in [(2.0, least), (0.99, 2.0 * least), (1.0, least), (1e-9, most), (0.0, most)] {
            assert_eq!(units_across(longest), units, "{longest}");
        }
    }
}
