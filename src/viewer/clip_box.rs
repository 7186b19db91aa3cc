//! Boxes over the picture: the mesh's, and the one that it is cut to, whose sides can be pulled.

use eframe::egui::{Color32, Painter, Pos2, Rect, Stroke, vec2};
use glam::DVec3;

use crate::scene::{Camera, Projection};
use crate::space::Bounds;

/// How near a side's handle is taken hold of, points.
const NEAR: f32 = 12.0;
/// Boxes stay this share of the mesh wide.
const LEAST: f64 = 1e-3;

/// A side of a box: its axis, and whether it is the upper one.
pub type Side = (usize, bool);

/// Where a place in data space is on the screen; `None` behind the eye.
pub fn project(camera: &Camera, rect: Rect, p: DVec3) -> Option<Pos2> {
    let (basis, away) = (camera.basis(), p - camera.eye);
    let [x, y, depth] = [basis.right, basis.up, basis.forward].map(|axis| away.dot(axis));
    let half = match camera.projection {
        Projection::Perspective { fov_y } if depth > 0.0 => (0.5 * fov_y).tan() * depth,
        Projection::Perspective { .. } => return None,
        Projection::Orthographic { height } => 0.5 * height,
    };
    let to_points = 0.5 * f64::from(rect.height()) / half;
    Some(rect.center() + vec2((x * to_points) as f32, (-y * to_points) as f32))
}

/// The edges.
pub fn draw(painter: &Painter, rect: Rect, camera: &Camera, bounds: &Bounds, stroke: Stroke) {
    let corners = bounds.corners().map(|corner| project(camera, rect, corner));
    for a in 0..8 {
        for bit in [1, 2, 4] {
            if let (0, Some(from), Some(to)) = (a & bit, corners[a], corners[a | bit]) {
                painter.line_segment([from, to], stroke);
            }
        }
    }
}

fn middle(bounds: &Bounds, (axis, is_upper): Side) -> DVec3 {
    let mut middle = bounds.center();
    middle[axis] = if is_upper { bounds.max[axis] } else { bounds.min[axis] };
    middle
}

fn sides() -> impl Iterator<Item = Side> {
    (0..3).flat_map(|axis| [(axis, false), (axis, true)])
}

/// A dot in the middle of each side, coloured on the one that is held or under the pointer.
pub fn draw_handles(painter: &Painter, rect: Rect, camera: &Camera, clip: &Bounds, marked: Option<Side>) {
    for side in sides() {
        if let Some(at) = project(camera, rect, middle(clip, side)) {
            let fill = if marked == Some(side) { COLOR } else { Color32::WHITE };
            painter.circle(at, 5.0, fill, Stroke::new(1.5, Color32::BLACK));
        }
    }
}

/// Of the clipping box.
pub const COLOR: Color32 = Color32::from_rgb(255, 190, 60);

/// The side whose handle is at a place; of several, the one nearest to the eye.
pub fn side_at(camera: &Camera, rect: Rect, clip: &Bounds, pointer: Pos2) -> Option<Side> {
    let is_near =
        |side: &Side| project(camera, rect, middle(clip, *side)).is_some_and(|at| at.distance(pointer) <= NEAR);
    let depth = |side: &Side| (middle(clip, *side) - camera.eye).dot(camera.basis().forward);
    sides().filter(is_near).min_by(|a, b| depth(a).total_cmp(&depth(b)))
}

/// Pulls a side along its axis to where that passes the pointer's ray nearest; boxes stay within `bounds`, and boxes.
pub fn pull(clip: &mut Bounds, side: Side, camera: &Camera, rect: Rect, pointer: Pos2, bounds: &Bounds) {
    let at = pointer - rect.min;
    // Fine enough that whole numbers of the size do not matter.
    let size = [rect.width(), rect.height()].map(|v| (64.0 * v).round().max(1.0) as u32);
    let ray = camera.ray(size, [at.x, at.y].map(|v| 64.0 * f64::from(v)));
    let (axis, is_upper) = side;
    let (from, way) = (middle(clip, side), DVec3::AXES[axis]);
    // |from + t way - origin - u direction|, least over t and u.
    let (apart, b, e) = (from - ray.origin, way.dot(ray.direction), ray.direction.length_squared());
    let slant = e - b * b;
    if slant < 1e-6 * e {
        return;
    }
    let t = (b * ray.direction.dot(apart) - e * way.dot(apart)) / slant;
    let least = LEAST * (bounds.max[axis] - bounds.min[axis]);
    let place = from[axis] + t;
    if is_upper {
        clip.max[axis] = place.min(bounds.max[axis]).max(clip.min[axis] + least);
    } else {
        clip.min[axis] = place.max(bounds.min[axis]).min(clip.max[axis] - least);
    }
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    fn cameras() -> [Camera; 2] {
        let (eye, target) = (DVec3::new(9.0, -3.0, 4.0), DVec3::new(0.5, 1.0, 0.0));
        [Projection::Perspective { fov_y: 0.8 }, Projection::Orthographic { height: 7.0 }].map(|projection| Camera {
            eye,
            target,
            up: DVec3::Z,
            projection,
            near: None,
        })
    }

    /// A place on a pixel's ray is drawn at that pixel.
    #[test]
    fn places_are_drawn_where_rays_meet_them() {
        let rect = Rect::from_min_size(pos2(40.0, 30.0), vec2(320.0, 200.0));
        for camera in cameras() {
            for pixel in [[10.0, 20.0], [160.0, 100.0], [300.0, 150.0]] {
                let ray = camera.ray([320, 200], pixel);
                let at = project(&camera, rect, ray.origin + 6.5 * ray.direction).expect("before the eye");
                let want = rect.min + vec2(pixel[0] as f32, pixel[1] as f32);
                assert!(at.distance(want) < 1e-2, "{at:?}, not {want:?}");
            }
        }
    }

    #[test]
    fn a_side_goes_where_it_is_pulled_and_no_further_than_the_box() {
        let rect = Rect::from_min_size(pos2(40.0, 30.0), vec2(320.0, 200.0));
        let bounds = Bounds { min: DVec3::splat(-1.0), max: DVec3::splat(1.5) };
        for camera in cameras() {
            for side in sides() {
                let mut clip = bounds;
                let handle = project(&camera, rect, middle(&clip, side)).expect("seen");
                let found = side_at(&camera, rect, &clip, handle).expect("a handle");
                let depth = |side| (middle(&clip, side) - camera.eye).dot(camera.basis().forward);
                assert!(found == side || depth(found) < depth(side), "{side:?}: {found:?}");
                let mut place = middle(&clip, side);
                place[side.0] = 0.4;
                let to = project(&camera, rect, place).expect("seen");
                pull(&mut clip, side, &camera, rect, to, &bounds);
                let got = if side.1 { clip.max } else { clip.min };
                assert!((got[side.0] - 0.4).abs() < 1e-4, "{side:?}: {got}");
                // Beyond the other side, and out of the mesh.
                for far in [-9.0, 9.0] {
                    place[side.0] = far;
                    let Some(to) = project(&camera, rect, place) else { continue };
                    pull(&mut clip, side, &camera, rect, to, &bounds);
                    assert!(clip.min.cmplt(clip.max).all(), "{clip:?}");
                    assert!(clip.min.cmpge(bounds.min).all() && clip.max.cmple(bounds.max).all(), "{clip:?}");
                }
            }
        }
    }
}
