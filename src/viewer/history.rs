//! Undo and redo, without limit.

/// States that were, the one that is, and those that were undone.
#[derive(Clone, Debug)]
pub struct History<T> {
    past: Vec<T>,
    now: T,
    future: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    /// Without a past.
    pub fn new(now: T) -> Self {
        Self { past: Vec::new(), now, future: Vec::new() }
    }

    /// Takes what is seen as a step, once it is not being changed any more (`is_settled`): a drag is one step.
    pub fn observe(&mut self, seen: &T, is_settled: bool) {
        if is_settled && *seen != self.now {
            self.past.push(std::mem::replace(&mut self.now, seen.clone()));
            self.future.clear();
        }
    }

    /// The state before.
    pub fn undo(&mut self) -> Option<&T> {
        let before = self.past.pop()?;
        self.future.push(std::mem::replace(&mut self.now, before));
        Some(&self.now)
    }

    /// The state that was undone last.
    pub fn redo(&mut self) -> Option<&T> {
        let after = self.future.pop()?;
        self.past.push(std::mem::replace(&mut self.now, after));
        Some(&self.now)
    }

    /// Steps that can be undone, and redone.
    pub fn steps(&self) -> [usize; 2] {
        [self.past.len(), self.future.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drag_is_one_step_and_a_new_step_ends_the_future() {
        let mut history = History::new(0);
        for (seen, is_settled) in [(1, false), (2, false), (3, true), (3, true), (4, true)] {
            history.observe(&seen, is_settled);
        }
        assert_eq!(history.steps(), [2, 0]);
        assert_eq!(history.undo(), Some(&3));
        assert_eq!(history.undo(), Some(&0));
        assert_eq!(history.undo(), None);
        assert_eq!(history.redo(), Some(&3));
        history.observe(&3, true);
        assert_eq!(history.steps(), [1, 1], "nothing new was seen");
        history.observe(&9, true);
        assert_eq!(history.redo(), None);
        assert_eq!(history.undo(), Some(&3));
    }
}
