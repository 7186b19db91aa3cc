//! The stability suite on the host: every row has the verdict that is known, and planted faults are caught.

#![expect(clippy::print_stdout, reason = "what was measured, for `--nocapture`")]

mod faults;
mod verdicts;

use tetralux::report::stability::{Entrant, cases};

#[test]
fn every_row_has_its_verdict() {
    for case in cases::all() {
        let entrants = Entrant::on_host(case.integrals).expect("integrals");
        verdicts::assert_told(&verdicts::assert_known(&case, &entrants, None));
    }
}
