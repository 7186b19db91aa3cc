//! A window that is driven by events.

use std::path::{Path, PathBuf};
use std::time::Duration;

use eframe::egui::{Pos2, Rect};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

// The crate's own tests and those beside it have it from different places.
use super::App;

pub fn fire() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/data/fire_ug.vtu")
}

/// Frames until nothing is being done beside the window.
pub fn settle(window: &mut Harness<'_, App>) {
    for _ in 0..6_000 {
        window.step();
        if window.state().is_idle() {
            // What a frame changes is asked for at its end.
            window.step();
            if window.state().is_idle() {
                return;
            }
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("nothing came of it: {:?}", window.state().messages());
}

pub fn place(window: &Harness<'_, App>, name: &str) -> Rect {
    window.get_by_label(name).rect()
}

/// Press, move and let go, a frame each.
pub fn drag(window: &mut Harness<'_, App>, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for share in [0.25, 0.5, 1.0] {
        window.hover_at(from + share * (to - from));
        window.step();
    }
    window.drop_at(to);
    window.step();
}
