//! What the host writes is what the shaders read: every struct of `gpu::layout` against naga's layout of it.

use std::collections::BTreeSet;

use tetralux::gpu::layout;
use tetralux::gpu::shader::{Module, pass_names};

/// A struct as Rust lays it out.
struct Host {
    name: &'static str,
    size: usize,
    /// In order: name and offset in bytes.
    members: Vec<(&'static str, usize)>,
}

/// Lists a struct's fields; leaving one out does not compile.
macro_rules! host {
    ($ty:ident { $($field:ident),* $(,)? }) => {{
        let layout::$ty { $($field: _),* } = layout::$ty::default();
        Host {
            name: stringify!($ty),
            size: size_of::<layout::$ty>(),
            members: vec![$((stringify!($field), std::mem::offset_of!(layout::$ty, $field))),*],
        }
    }};
}

fn hosts() -> Vec<Host> {
    vec![
        host!(Frame {
            reference,
            tet_count,
            eye_from_reference,
            vertex_count,
            x_row,
            image_width,
            y_row,
            image_height,
            forward,
            ray_per_clip_x,
            ray_per_clip_y,
            chunk_cells,
            most_drawn,
            pad_a,
            background,
            x_offset,
            y_offset,
            z_offset,
            pad_b,
        }),
        host!(Rays {
            right,
            least_transmittance,
            up,
            near,
            forward,
            groups,
            film,
            film_step,
            start,
            start_step,
            pixel,
            size,
            background,
            first_row,
            goes_on,
            eye,
            units,
        }),
        host!(Light { direction, ambient, diffuse, specular, shininess, strength, exponent, pad_a, pad_b, pad_c }),
        host!(Range { first_tet, tet_count, pad_a, pad_b }),
        host!(Counts { survivors, sort_tiles, pad_a, pad_b, sort_groups_x, sort_groups_y, sort_groups_z, pad_c }),
        host!(Widget {
            whiten,
            center,
            extinction,
            shape,
            color,
            pad_a,
            scalar_low,
            scalar_high,
            gradient_low,
            gradient_high,
            window_direction,
            pad_b,
            knots,
        }),
        host!(SegmentCase { front, back, extent, first_widget, widget_count, pad }),
        host!(SegmentResult { color, pieces, pad_a, pad_b, pad_c }),
        host!(Piece { origin, slope }),
        host!(BandTotals { bands, pairs, most, deep }),
        host!(Strip { first_pixel, end_pixel, base, goes_on }),
        host!(Chunk { first_cell, cells, pad_a, pad_b }),
        host!(Grid {
            points,
            least_depth,
            nearest,
            longest_edge,
            low,
            pad_a,
            high,
            pad_b,
            near_low,
            pad_c,
            near_high,
            pad_d,
        }),
        host!(BrickCount { cells, bands, pairs, most }),
    ]
}

/// What differs between the host's and the shader's struct.
fn difference(host: &Host, size: u32, members: &[(String, u32)]) -> Option<String> {
    if size as usize != host.size {
        return Some(format!("{} has {} bytes on the host and {size} in the shader", host.name, host.size));
    }
    let theirs: Vec<(&str, usize)> = members.iter().map(|(name, at)| (name.as_str(), *at as usize)).collect();
    (theirs != host.members).then(|| format!("{}: host {:?}, shader {theirs:?}", host.name, host.members))
}

/// Structs that the module's buffers hold, at any depth.
fn structs_in_buffers(module: &naga::Module) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut next: Vec<_> =
        module.global_variables.iter().filter(|(_, v)| v.binding.is_some()).map(|(_, v)| v.ty).collect();
    while let Some(handle) = next.pop() {
        let ty = &module.types[handle];
        match &ty.inner {
            naga::TypeInner::Array { base, .. } => next.push(*base),
            naga::TypeInner::Struct { members, .. } => {
                names.extend(ty.name.clone());
                next.extend(members.iter().map(|m| m.ty));
            }
            _ => {}
        }
    }
    names
}

#[test]
fn hosts_and_shaders_agree() {
    let hosts = hosts();
    let mut seen = BTreeSet::new();
    for pass in pass_names() {
        let module = Module::new(pass).expect("a pass");
        for host in &hosts {
            if let Some((size, members)) = module.struct_layout(host.name) {
                assert_eq!(difference(host, size, &members), None, "in '{pass}'");
                seen.insert(host.name.to_owned());
            }
        }
        for name in structs_in_buffers(&module.naga) {
            assert!(hosts.iter().any(|h| h.name == name), "'{pass}' binds {name}, which src/gpu/layout.rs lacks");
        }
    }
    let listed: BTreeSet<String> = hosts.iter().map(|h| h.name.to_owned()).collect();
    assert_eq!(seen, listed, "every struct of src/gpu/layout.rs is some shader's");
}

#[test]
fn planted_differences_are_found() {
    let host = host!(Range { first_tet, tet_count, pad_a, pad_b });
    let layout_of = |members: &str| {
        let source = format!("struct Range {{ {members} }} @group(0) @binding(0) var<uniform> range: Range;");
        let module = naga::front::wgsl::parse_str(&source).expect("a struct");
        assert!(structs_in_buffers(&module).contains("Range"));
        let name = "planted";
        Module { name, source, bindings: Vec::new(), naga: module }.struct_layout("Range").expect("a struct")
    };
    let check = |members: &str| {
        let (size, members) = layout_of(members);
        difference(&host, size, &members)
    };
    let sound = "first_tet: u32, tet_count: u32, pad_a: u32, pad_b: u32,";
    assert_eq!(check(sound), None);
    for (what, members) in [
        ("exchanged", sound.replace("first_tet: u32, tet_count", "tet_count: u32, first_tet")),
        ("renamed", sound.replace("tet_count", "cell_count")),
        ("padded", sound.replace("pad_b: u32", "pad_b: vec4u")),
        ("of another alignment", sound.replace("tet_count: u32", "@align(16) tet_count: u32")),
        ("missing", sound.replace("pad_b: u32,", "")),
    ] {
        assert!(check(&members).is_some(), "a member {what} went unseen: {members}");
    }
}
