//! The window: how it looks, and a session in it under a display without a screen.

#![cfg(feature = "viewer-test")]
#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

use std::path::Path;
use std::time::Instant;

use eframe::egui::{Event, Key, Pos2, Rect, Role, Theme, vec2};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{Harness, SnapshotOptions, try_image_snapshot_options};
use image::RgbaImage;
use tetralux::gpu::{DeviceChoice, Gpu};
use tetralux::viewer::{App, How, Start};

#[path = "common/window.rs"]
mod driven;

use driven::{drag, fire, place, settle};

fn window(theme: Theme) -> Harness<'static, App> {
    let start = Start { mesh: Some(fire()), field: Some("t".into()), scene: None, how: How::default() };
    let mut window = Harness::builder()
        .with_size(vec2(1000.0, 700.0))
        .with_theme(theme)
        .wgpu()
        .build_eframe(|context| App::new(context, start, None).unwrap_or_else(|e| panic!("{e}")));
    settle(&mut window);
    window
}

fn press(window: &mut Harness<'_, App>, key: Key) {
    window.key_press(key);
    window.step();
    window.step();
}

/// Away from what would be marked under the pointer.
fn rest(window: &mut Harness<'_, App>) {
    window.event(Event::PointerGone);
    settle(window);
}

fn picture_of(window: &mut Harness<'_, App>, part: Rect) -> RgbaImage {
    let mut all = window.render().unwrap_or_else(|e| panic!("{e}"));
    // A window begins with the application's colour, and this with nothing (premultiplied).
    let below = eframe::App::clear_color(window.state(), &window.ctx.global_style().visuals);
    for pixel in all.pixels_mut() {
        let through = f32::from(255 - pixel[3]);
        for (channel, below) in pixel.0.iter_mut().zip(below) {
            *channel = (f32::from(*channel) + below * through).round() as u8;
        }
    }
    let [x, y, w, h] = [part.left(), part.top(), part.width(), part.height()].map(|v| v.max(0.0) as u32);
    image::imageops::crop_imm(&all, x, y, w.min(all.width() - x), h.min(all.height() - y)).to_image()
}

/// Of the panel beside the picture; what it says does not depend on the machine.
fn panel(window: &mut Harness<'_, App>) -> RgbaImage {
    let picture = place(window, "Picture");
    let part = Rect::from_min_max(picture.right_top(), picture.right_bottom() + vec2(1_000.0, 0.0));
    picture_of(window, part)
}

/// Edges may be rasterised a little otherwise by another version of the driver.
fn options() -> SnapshotOptions {
    SnapshotOptions::new().threshold(0.6).max_failed_pixels(60_usize)
}

fn check(name: &str, image: &RgbaImage) {
    try_image_snapshot_options(image, name, &options()).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn the_editor_looks_as_it_did() {
    let mut window = window(Theme::Dark);
    press(&mut window, Key::G);
    let plot = place(&window, "Joint histogram");
    let from = plot.min + 0.45 * plot.size();
    drag(&mut window, from, from + vec2(40.0, -25.0));
    rest(&mut window);
    let editor = panel(&mut window);
    check("editor_dark", &editor);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        // Whatever is held against one becomes it.
        return;
    }
    // A handle that is not where it was is another picture.
    let folder = tempfile::tempdir().expect("a folder");
    let planted = options().output_path(folder.path());
    editor.save(folder.path().join("planted.png")).expect("written");
    try_image_snapshot_options(&editor, "planted", &planted).unwrap_or_else(|e| panic!("{e}"));
    let mut moved = editor.clone();
    for y in (120..200).rev() {
        for x in 80..300 {
            moved.put_pixel(x, y, *editor.get_pixel(x, y - 3));
        }
    }
    assert!(try_image_snapshot_options(&moved, "planted", &planted).is_err());
}

#[test]
fn the_curve_looks_as_it_did() {
    let mut window = window(Theme::Light);
    press(&mut window, Key::K);
    rest(&mut window);
    check("curve_light", &panel(&mut window));
}

#[test]
fn the_picture_looks_as_it_did() {
    let mut window = window(Theme::Dark);
    for key in [Key::L, Key::I] {
        press(&mut window, key);
    }
    rest(&mut window);
    let picture = place(&window, "Picture");
    check("picture_dark", &picture_of(&mut window, picture));
}

/// Frames of the window, drawn and read back, while the reference is made beside them.
#[test]
fn frames_come_while_a_still_is_made() {
    let mut window = window(Theme::Dark);
    let picture = place(&window, "Picture");
    press(&mut window, Key::E);
    drag(&mut window, picture.min + vec2(5.0, 5.0), picture.max - vec2(5.0, 5.0));
    assert!(!window.state().is_idle());
    let mut times = [Vec::new(), Vec::new()];
    for i in 0..40_u8 {
        let start = Instant::now();
        window.hover_at(picture.min + vec2(50.0 + f32::from(i), 60.0));
        window.step();
        let stepped = start.elapsed();
        window.render().unwrap_or_else(|e| panic!("{e}"));
        // The first one makes pipelines.
        if i > 0 && !window.state().is_idle() {
            times[0].push(stepped);
            times[1].push(start.elapsed());
        }
    }
    for (name, times) in ["laid out", "and drawn, its pixels read back"].into_iter().zip(&mut times) {
        times.sort();
        let [median, most] = [times.len() / 2, times.len() - 1].map(|i| 1e3 * times[i].as_secs_f64());
        println!("a frame of the window, {name}: {median:.1} ms, {most:.1} at most, of {}", times.len());
    }
    press(&mut window, Key::Escape);
    assert!(window.state().is_idle(), "what is let go is not waited for");
}

/// The device is gone while the session goes on: that is said, and another one opened.
#[test]
fn a_lost_device_is_said_and_opened_again() {
    let gpu = Gpu::new(DeviceChoice::Any).unwrap_or_else(|e| panic!("{e}"));
    let (_, _, device, _) = gpu.parts();
    let start = Start { mesh: Some(fire()), field: Some("t".into()), scene: None, how: How::default() };
    let mut window = Harness::builder()
        .with_size(vec2(1000.0, 700.0))
        .build_eframe(move |context| App::new(context, start, Some(gpu)).unwrap_or_else(|e| panic!("{e}")));
    settle(&mut window);
    // Not the CPU engine, which `auto` takes where software rasterises.
    window.get_by_label("How pictures are made").click();
    settle(&mut window);
    let device_choice = window.get_all_by_role(Role::ComboBox).nth(1).expect("field, device, ...").rect().center();
    click(&mut window, device_choice);
    window.get_by_label("gpu").click();
    settle(&mut window);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    let look = window.state().look().cloned();
    device.destroy();
    let picture = place(&window, "Picture").center();
    drag(&mut window, picture, picture + vec2(40.0, 0.0));
    settle(&mut window);
    let said = window.state().messages().to_vec();
    assert!(said.len() == 1, "{said:?}");
    drag(&mut window, picture, picture + vec2(40.0, 0.0));
    settle(&mut window);
    assert_eq!(window.state().messages(), said, "another device is there");
    assert_eq!(window.state().look().cloned(), look, "the session is kept");
}

fn click(window: &mut Harness<'_, App>, at: Pos2) {
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.step();
    window.step();
}

/// By synthetic X input; see `scripts/view_session.sh`.
#[cfg(target_os = "linux")]
#[test]
fn a_session_under_a_display_exports_what_the_command_line_renders() {
    let folder = tempfile::tempdir().expect("a folder");
    let done = std::process::Command::new("sh")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("scripts/view_session.sh"))
        .args([fire().as_os_str(), "t".as_ref(), folder.path().as_os_str()])
        .env("TETRALUX", env!("CARGO_BIN_EXE_tetralux"))
        .output()
        .expect("a shell");
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{said}\n{}", String::from_utf8_lossy(&done.stdout));
}
