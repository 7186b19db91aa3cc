//! How long the window takes to draw itself.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// Frames that are remembered.
const FRAMES: usize = 120;

/// Times of the last frames.
#[derive(Debug, Default)]
pub struct Clock {
    last: Option<Instant>,
    /// From one to the next, where the next was waited for.
    apart: VecDeque<Duration>,
}

impl Clock {
    /// A frame begins; `is_late`: something had come by then that the one before did not show. Without it, the window may
    /// have rested between the two.
    pub fn hear(&mut self, now: Instant, is_late: bool) {
        let apart = self.last.map(|last| now.saturating_duration_since(last));
        self.apart.extend(apart.filter(|_| is_late));
        if self.apart.len() > FRAMES {
            self.apart.pop_front();
        }
        self.last = Some(now);
    }

    /// From one frame to the next while something moves: half of them take no longer, and 19 of 20.
    pub fn median_and_95th(&self) -> Option<[Duration; 2]> {
        let mut sorted: Vec<Duration> = self.apart.iter().copied().collect();
        sorted.sort();
        Some([*sorted.get(sorted.len() / 2)?, *sorted.get(sorted.len() * 19 / 20)?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_frames_count_that_follow_each_other() {
        let mut clock = Clock::default();
        let mut now = Instant::now();
        assert_eq!(clock.median_and_95th(), None);
        let frames =
            [(0, true), (90, true), (120, false)].into_iter().chain([(20, true); FRAMES]).chain([(40, true); 7]);
        for (milliseconds, is_late) in frames {
            now += Duration::from_millis(milliseconds);
            clock.hear(now, is_late);
        }
        // Rest is no slow frame, and the one of 90 ms is forgotten.
        assert_eq!(clock.median_and_95th(), Some([20, 40].map(Duration::from_millis)));
    }
}
