//! Threads for what the window does not wait for.

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

use crate::error::{Error, Result};

/// Of 100, where threads have 50: the window's go first. Less did not make its frames shorter.
const PRIORITY: u8 = 25;

/// As many threads as there are cores but one, which is left to the window.
///
/// # Errors
/// No threads can be made.
pub fn pool() -> Result<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    rayon::ThreadPoolBuilder::new()
        .num_threads((cores - 1).max(1))
        .start_handler(|_| yield_to_the_window())
        .build()
        .map_err(|e| Error::Device(format!("no threads can be made to render on: {e}")))
}

/// Of the thread that calls it. Where the system refuses, pictures come as fast and the window may be slower.
fn yield_to_the_window() {
    if let Ok(priority) = ThreadPriorityValue::try_from(PRIORITY) {
        let _ = set_current_thread_priority(ThreadPriority::Crossplatform(priority));
    }
}
