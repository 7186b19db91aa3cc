//! The stability suite on a device: every row has the verdict that is known.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

#[path = "../stability/verdicts.rs"]
mod verdicts;

use tetralux::gpu::{DeviceChoice, Gpu};
use tetralux::report::stability::{Entrant, cases};

#[test]
fn every_row_has_its_verdict() {
    let choice = match std::env::var("TETRALUX_GPU").as_deref() {
        Ok("hardware") => DeviceChoice::Hardware,
        _ => DeviceChoice::Software,
    };
    let gpu = Gpu::new(choice).unwrap_or_else(|e| panic!("{e}"));
    for case in cases::all() {
        verdicts::assert_told(&verdicts::assert_known(&case, &Entrant::ON_DEVICE, Some(&gpu)));
    }
}
