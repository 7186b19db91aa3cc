//! Threads for what the window does not wait for, and which make way for it while somebody uses it.

use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use thread_priority::{ThreadPriority, ThreadPriorityValue, set_current_thread_priority};

use crate::error::{Error, Result};

/// Of 100, where threads have 50: the window's go first.
const PRIORITY: u8 = 25;
/// Who has done nothing for so long is not at the window.
const REST: Duration = Duration::from_millis(300);

/// As many threads as there are cores but one, which is left to the window.
///
/// # Errors
/// No threads can be made.
pub fn pool() -> Result<rayon::ThreadPool> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    rayon::ThreadPoolBuilder::new()
        .num_threads((cores - 1).max(1))
        .start_handler(|_| {
            // Where the system refuses, pictures come as fast and the window may be slower.
            if let Ok(priority) = ThreadPriorityValue::try_from(PRIORITY) {
                let _ = set_current_thread_priority(ThreadPriority::Crossplatform(priority));
            }
            way::join();
        })
        .exit_handler(|_| way::leave())
        .build()
        .map_err(|e| no_threads(&e))
}

fn no_threads(why: &impl std::fmt::Display) -> Error {
    Error::Device(format!("no threads can be made to render on: {why}"))
}

/// Makes the pools' threads make way for the window.
pub struct Steward(Sender<()>);

impl Steward {
    /// Begins, on a thread of its own: it waits until nobody uses the window.
    ///
    /// # Errors
    /// No thread can be made.
    pub fn new() -> Result<Self> {
        let (sender, heard) = channel();
        let work = move || {
            while heard.recv().is_ok() {
                way::make(true);
                // Again, for threads that are new.
                while heard.recv_timeout(REST).is_ok() {
                    way::make(true);
                }
                way::make(false);
            }
        };
        std::thread::Builder::new().spawn(work).map_err(|e| no_threads(&e))?;
        Ok(Self(sender))
    }

    /// Somebody uses the window.
    pub fn hear(&self) {
        // Without the thread, the others have their priority still.
        let _ = self.0.send(());
    }
}

/// A low priority alone does not keep frames short on Linux: a waking thread of the window's is put where another one of them
/// already waits, rather than where a thread of low priority runs, until the scheduler next evens them out. Where what runs is
/// of the idle policy, a core counts as free. But beside other programs that policy gets next to nothing: so it is for a while.
#[cfg(target_os = "linux")]
mod way {
    use std::sync::{Mutex, MutexGuard, PoisonError};

    use thread_priority::ThreadPriority;
    use thread_priority::unix::{
        NormalThreadSchedulePolicy, ThreadId, ThreadSchedulePolicy, set_thread_priority_and_policy, thread_native_id,
    };

    /// No thread ends while this is held: each is there.
    static CREW: Mutex<Vec<ThreadId>> = Mutex::new(Vec::new());

    fn crew() -> MutexGuard<'static, Vec<ThreadId>> {
        CREW.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The calling thread is one of those.
    pub fn join() {
        crew().push(thread_native_id());
    }

    /// The calling thread ends.
    pub fn leave() {
        crew().retain(|thread| *thread != thread_native_id());
    }

    /// All make way, or not any more.
    pub fn make(is_made: bool) {
        let policy = if is_made { NormalThreadSchedulePolicy::Idle } else { NormalThreadSchedulePolicy::Other };
        for &thread in &*crew() {
            // Theirs is the policy; the priority is the calling thread's. Where the system refuses, the window may be slower.
            let _ = set_thread_priority_and_policy(thread, ThreadPriority::Max, ThreadSchedulePolicy::Normal(policy));
        }
    }
}

/// Elsewhere priorities do.
#[cfg(not(target_os = "linux"))]
mod way {
    pub fn join() {}
    pub fn leave() {}
    pub fn make(_: bool) {}
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use std::time::Instant;

    use thread_priority::unix::{
        NormalThreadSchedulePolicy, ThreadSchedulePolicy, thread_native_id, thread_schedule_policy_param,
    };

    use super::*;

    #[test]
    fn threads_make_way_while_somebody_uses_the_window() {
        let pool = pool().expect("threads");
        let steward = Steward::new().expect("a thread");
        let thread = pool.install(thread_native_id);
        let becomes = |policy| {
            let wanted = ThreadSchedulePolicy::Normal(policy);
            let end = Instant::now() + Duration::from_secs(20);
            while thread_schedule_policy_param(thread).expect("a policy").0 != wanted {
                assert!(Instant::now() < end, "{wanted:?} is waited for");
                std::thread::sleep(Duration::from_millis(5));
            }
        };
        becomes(NormalThreadSchedulePolicy::Other);
        steward.hear();
        becomes(NormalThreadSchedulePolicy::Idle);
        becomes(NormalThreadSchedulePolicy::Other);
    }
}
