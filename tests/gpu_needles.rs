//! Cells that look like needles, or have corners all but on an edge, are drawn where they are and nowhere else.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod common;

use std::sync::Arc;

use common::boxes::tet_mesh;
use common::gpu;
use common::random::Random;
use glam::{DVec2, DVec3};
use tetralux::image::Image;
use tetralux::renderer::Method;
use tetralux::scene::{Camera, Projection, TransferFunction, Widget, WidgetShape};
use tetralux::tet::TetMesh;

const SIZE: f64 = 1024.0;
/// Pixels between the middles of cells, 26 along each side.
const SPACING: f64 = 38.0;
const PER_SIDE: usize = 26;
/// Pixels: farther from a cell's bounding box it must not be seen.
const MARGIN: f64 = 1.0;
/// Opacity that counts as seen.
const LEAST: f32 = 1e-4;
const FOV_Y: f64 = 0.5;

fn camera() -> Camera {
    let projection = Projection::Perspective { fov_y: FOV_Y };
    Camera { eye: DVec3::new(0.0, 0.0, 4.0), target: DVec3::ZERO, up: DVec3::Y, projection, near: None }
}

/// What is seen at a pixel position, so far in front of the camera.
fn place(pixel: DVec2, depth: f64) -> DVec3 {
    let half = (0.5 * FOV_Y).tan() * depth;
    let at = (2.0 * pixel / SIZE - 1.0) * half;
    DVec3::new(at.x, -at.y, 4.0 - depth)
}

/// Corners on screen: two a few pixels apart, one all but on the line through both, one somewhat beside that line.
fn cell(random: &mut Random, middle: DVec2) -> [DVec2; 4] {
    let off = 10f64.powf(random.within(-7.0, -2.0));
    let aside = 10f64.powf(random.within(-7.0, 1.0)).min(2.0);
    let along = DVec2::from_angle(random.within(0.0, std::f64::consts::TAU));
    let length = random.within(1.0, 6.0);
    let across = along.perp();
    let side = |random: &mut Random| if random.unit() < 0.5 { -1.0 } else { 1.0 };
    let b = length * random.within(0.3, 1.2);
    let c = length * random.within(-0.2, 1.2);
    let corner = |x: f64, y: f64| middle + x * along + y * across;
    [corner(0.0, 0.0), corner(length, 0.0), corner(b, off * side(random)), corner(c, aside * side(random))]
}

/// A cell in the middle of each square, and their bounding boxes on screen.
fn needles(random: &mut Random) -> (Arc<TetMesh>, Vec<[DVec2; 2]>) {
    let (mut points, mut tets, mut boxes) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..PER_SIDE * PER_SIDE {
        let square = DVec2::new((i % PER_SIDE) as f64, (i / PER_SIDE) as f64);
        let middle = SPACING * (square + 0.5) + DVec2::new(random.unit(), random.unit());
        let corners = cell(random, middle);
        let places = corners.map(|pixel| place(pixel, 4.0 + random.within(-0.2, 0.2)));
        let first = points.len() as u32;
        let mut tet = [0, 1, 2, 3].map(|k| first + k);
        let [a, b, c, d] = places;
        if (b - a).cross(c - a).dot(d - a) < 0.0 {
            tet.swap(2, 3);
        }
        points.extend(places);
        tets.push(tet);
        boxes.push([
            corners[1..].iter().fold(corners[0], |m, p| m.min(*p)),
            corners[1..].iter().fold(corners[0], |m, p| m.max(*p)),
        ]);
    }
    (Arc::new(tet_mesh(&points, tets, |p| [p.x, 0.0])), boxes)
}

/// Pixels that show something farther than the margin from the cell of their square.
fn astray(image: &Image, boxes: &[[DVec2; 2]]) -> usize {
    let is_astray = |(i, pixel): (usize, &[f32; 4])| {
        let at = DVec2::new((i % SIZE as usize) as f64 + 0.5, (i / SIZE as usize) as f64 + 0.5);
        let far = |[min, max]: &[DVec2; 2]| at.cmplt(*min - MARGIN).any() || at.cmpgt(*max + MARGIN).any();
        pixel[3] > LEAST && boxes.iter().all(far)
    };
    image.pixels.iter().enumerate().filter(|&p| is_astray(p)).count()
}

/// Of pictures of needles: pixels that are astray; of the first, also without a box.
fn assert_stay(method: Method, pictures: usize) {
    let transfer = TransferFunction::Widgets(vec![Widget::new(WidgetShape::Uniform, [1.0; 3], 100.0)]);
    let mut random = Random(3);
    let (mut count, mut seen) = (0, 0);
    for _ in 0..pictures {
        let (mesh, mut boxes) = needles(&mut random);
        let size = [SIZE as u32; 2];
        let image = gpu::draw(&mut gpu::renderer(&mesh, gpu::by(method)), &camera(), &transfer, size).image;
        seen += image.pixels.iter().filter(|p| p[3] > LEAST).count();
        count += astray(&image, &boxes);
        boxes.truncate(PER_SIDE * PER_SIDE / 2);
        assert!(astray(&image, &boxes) > 100, "cells without a box are not seen astray");
    }
    println!("{method:?}: {count} of {seen} pixels astray");
    assert!(count == 0 && seen > 250 * pictures, "{method:?}: {count} of {seen} pixels astray");
}

#[test]
fn outlines_stay() {
    assert_stay(Method::Project, 8);
}

#[test]
fn front_faces_stay() {
    assert_stay(Method::CellCast, 8);
}
