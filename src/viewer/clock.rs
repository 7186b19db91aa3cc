//! How long the window takes to draw itself.

use std::collections::VecDeque;

/// Frames that are remembered.
const FRAMES: usize = 120;

/// Times of the last frames.
#[derive(Debug, Default)]
pub struct Clock {
    seconds: VecDeque<f32>,
}

impl Clock {
    /// What the last frame took, if that is known.
    pub fn hear(&mut self, seconds: Option<f32>) {
        self.seconds.extend(seconds);
        if self.seconds.len() > FRAMES {
            self.seconds.pop_front();
        }
    }

    /// Median and most of the last frames, seconds.
    pub fn median_and_most(&self) -> Option<[f32; 2]> {
        let mut sorted: Vec<f32> = self.seconds.iter().copied().collect();
        sorted.sort_by(f32::total_cmp);
        Some([*sorted.get(sorted.len() / 2)?, *sorted.last()?])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_frames_count() {
        let mut clock = Clock::default();
        assert_eq!(clock.median_and_most(), None);
        clock.hear(Some(9.0));
        for _ in 0..FRAMES {
            clock.hear(None);
            clock.hear(Some(0.25));
        }
        assert_eq!(clock.median_and_most(), Some([0.25, 0.25]), "the slow one is forgotten");
        clock.hear(Some(0.5));
        assert_eq!(clock.median_and_most(), Some([0.25, 0.5]));
    }
}
