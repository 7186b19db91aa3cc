//! Progress on stderr for what takes over half a second, where stderr is a terminal.

use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Work shorter than this is not announced.
const PATIENCE: Duration = Duration::from_millis(500);

/// Runs `work`; a spinner named `what` turns meanwhile.
pub(super) fn step<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    step_with(ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()).with_message(what), work)
}

/// A bar named `what` over 1000 thousandths, hidden until [`step_with`] finds the work long.
pub(super) fn bar(what: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::hidden()).with_message(what);
    match ProgressStyle::with_template("{msg} {bar:40} {percent} % {eta}") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}

/// Runs `work` and shows `bar` once it takes long.
pub(super) fn step_with<T>(bar: ProgressBar, work: impl FnOnce() -> T) -> T {
    let (done, waiting) = channel::<()>();
    let shown = bar.clone();
    let watcher = std::thread::spawn(move || {
        if waiting.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
            // Hides itself where stderr is no terminal.
            shown.set_draw_target(ProgressDrawTarget::stderr());
            shown.enable_steady_tick(Duration::from_millis(100));
        }
    });
    let result = work();
    drop(done);
    // A watcher that panicked has nothing to show.
    let _ = watcher.join();
    bar.finish_and_clear();
    result
}
