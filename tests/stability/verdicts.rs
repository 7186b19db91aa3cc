//! What both halves of the suite ask: every row has the verdict that is known, and the page says so.

use std::path::Path;

use tetralux::gpu::Gpu;
use tetralux::report::stability::{Case, Entrant, Expected, Row, Verdict, run, worst};

/// Draws a case by `entrants` and fails where a row does, where the truth shows nothing, and where something is known that
/// does not happen.
pub fn assert_known(case: &Case, entrants: &[Entrant], gpu: Option<&Gpu>) -> Vec<Row> {
    let rows = run(case, entrants, gpu, |row, trial, _| {
        let o = &row.outcome;
        println!(
            "{:22} {:22} {:8.0e}  {:6.1} dB  99.9% {:.1e}  max {:.1e}  {}",
            row.case, row.entrant, row.value, o.psnr, o.percentile_99_9, o.max, o.verdict
        );
        let peak = trial.want.pixels.iter().fold(0.0, |most, p| f32::max(most, p[3]));
        let seen = trial.want.pixels.iter().filter(|p| p[3] > 0.01 * peak).count();
        assert!(20 * seen > trial.want.pixels.len(), "{} {}: {seen} pixels show anything", row.case, row.value);
    });
    let rows = rows.unwrap_or_else(|e| panic!("{}: {e}", case.name));
    let failed: Vec<_> = rows.iter().filter(|row| matches!(row.outcome.verdict, Verdict::Fails { .. })).collect();
    assert!(failed.is_empty(), "{failed:#?}");
    for known in case.known {
        let drawn = |row: &&Row| {
            known.entrants.contains(&row.entrant.as_str()) && (known.values[0]..=known.values[1]).contains(&row.value)
        };
        let happens = |row: &Row| match known.expected {
            Expected::Refuses => matches!(row.outcome.verdict, Verdict::Refuses { .. }),
            Expected::Degrades(_) | Expected::Misses => matches!(row.outcome.verdict, Verdict::Degrades { .. }),
        };
        let mut rows = rows.iter().filter(drawn).peekable();
        assert!(rows.peek().is_none() || rows.any(happens), "{}: known, and does not happen: {known:?}", case.name);
    }
    rows
}

/// Fails where `docs/stability.md` does not say of every entrant what becomes of it.
pub fn assert_told(rows: &[Row]) {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/stability.md");
    let page = std::fs::read_to_string(page).expect("the page");
    for row in worst(rows) {
        let line = format!("| {} | {} | {} |", row.case, row.entrant, row.outcome.verdict.word());
        assert!(page.contains(&line), "docs/stability.md does not say: {line}");
    }
}
