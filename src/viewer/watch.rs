//! How far a picture is, and whether anybody still waits for it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use crate::oracle::Progress;

/// Steps from nothing to a picture.
const STEPS: f64 = 1000.0;

/// Between whoever makes a picture and whoever waits for it; clones are of one picture.
#[derive(Clone, Debug, Default)]
pub struct Watch(Arc<State>);

#[derive(Debug, Default)]
struct State {
    steps: AtomicU32,
    is_given_up: AtomicBool,
}

/// Has the window drawn again.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

impl Watch {
    /// Hears for a renderer; the window is drawn again at each hundredth.
    pub fn progress(&self, wake: Wake) -> Progress {
        let watch = self.clone();
        Arc::new(move |share| {
            let percent = |share: f64| (100.0 * share) as u32;
            let is_news = percent(share) > percent(watch.share().unwrap_or(0.0));
            let goes_on = watch.hear(share);
            if is_news {
                wake();
            }
            goes_on
        })
    }

    /// Another picture is begun.
    pub fn begin(&self) {
        self.rewind();
        self.0.is_given_up.store(false, Ordering::Relaxed);
    }

    /// Another part of it is begun.
    pub fn rewind(&self) {
        self.0.steps.store(0, Ordering::Relaxed);
    }

    /// It is so far, 0 to 1; says whether to go on.
    fn hear(&self, share: f64) -> bool {
        self.0.steps.fetch_max((STEPS * share) as u32, Ordering::Relaxed);
        !self.is_given_up()
    }

    /// How far it is, 0 to 1; none before anything was heard.
    pub fn share(&self) -> Option<f64> {
        let steps = self.0.steps.load(Ordering::Relaxed);
        (steps > 0).then(|| f64::from(steps) / STEPS)
    }

    /// Nobody waits for it any more.
    pub fn give_up(&self) {
        self.0.is_given_up.store(true, Ordering::Relaxed);
    }

    /// Nobody waits for it.
    pub fn is_given_up(&self) -> bool {
        self.0.is_given_up.load(Ordering::Relaxed)
    }
}
