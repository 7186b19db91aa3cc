//! The window: a picture, and the function that makes it, drawn on the joint histogram.
//!
//! `app` holds what is open and asks `engine` for pictures, which are made by a thread of their own: nothing here waits for
//! one. `editor` and `curve` draw the two kinds of functions; what a pull on a handle does is in `handles`, what is
//! edited in `look`, undo in `history`: none of these three knows a window.

mod app;
mod background;
mod canvas;
mod clip_box;
mod clipping;
mod clock;
mod curve;
mod editor;
mod engine;
mod files;
mod handles;
mod history;
mod look;
mod opened;
mod pane;
mod panels;
mod path;
mod plot;
mod refine;
mod screen;
mod watch;

use std::ffi::OsString;

use eframe::egui_wgpu::wgpu::PresentMode;
use eframe::egui_wgpu::{SurfaceConfig, WgpuConfiguration, WgpuSetup, WgpuSetupExisting};

pub use app::{App, Compare, Start};
pub use engine::How;
pub use look::{Kind, Look};

use crate::cli;
use crate::cli::args::{IntegralChoice, ViewArgs};
use crate::error::Error;
use crate::gpu::Gpu;

/// Does what the arguments (the program's name first) ask, as [`cli::main`] does, and opens the window where they say so.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    cli::main_with(arguments, open)
}

/// What the command line asked for.
fn start(args: &ViewArgs) -> Start {
    let mut how = How { device: args.device, choices: args.choices };
    if how.choices.integral == IntegralChoice::default() {
        // What is still is made again and again: the cheapest that holds the tolerance.
        how.choices.integral = IntegralChoice::Auto;
    }
    Start { mesh: args.mesh.clone(), field: args.field.clone(), scene: args.scene.clone(), how }
}

fn open(args: &ViewArgs) -> anyhow::Result<()> {
    let gpu = Gpu::for_window()?;
    // A still on a software adapter would hold the window up: there pictures get a device of their own, or the CPU engine.
    let is_software = gpu.is_software();
    let shared = (!is_software).then(|| gpu.clone());
    let (instance, adapter, device, queue) = gpu.parts();
    let wgpu_setup = WgpuSetup::Existing(WgpuSetupExisting { instance, adapter, device, queue });
    // Where a processor rasterises there is no screen's beat to wait for.
    let surface = match is_software {
        true => SurfaceConfig { present_mode: PresentMode::AutoNoVsync, ..SurfaceConfig::LOW_LATENCY },
        false => SurfaceConfig::HIGH_THROUGHPUT,
    };
    let options = eframe::NativeOptions {
        viewport: eframe::egui::ViewportBuilder::default()
            .with_title("tetralux")
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([800.0, 500.0])
            .with_drag_and_drop(true),
        wgpu_options: WgpuConfiguration { wgpu_setup, surface, ..Default::default() },
        // A tenth of what a processor takes for the window.
        dithering: !is_software,
        ..Default::default()
    };
    let start = start(args);
    let make: eframe::AppCreator<'_> = Box::new(move |context| Ok(Box::new(App::new(context, start, shared)?)));
    eframe::run_native("tetralux", options, make)
        .map_err(|e| Error::Device(format!("the window cannot be opened: {e}")).into())
}
