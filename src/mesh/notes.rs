//! Collects what a reader leaves out, one note for each kind of thing.

use super::ReadNote;

/// Notes under way; equal texts are counted together.
#[derive(Default)]
pub(super) struct Notes(Vec<ReadNote>);

impl Notes {
    /// Adds `count` things of the kind `text`; nothing where there are none.
    pub(super) fn count(&mut self, text: &str, count: u64) {
        if count == 0 {
            return;
        }
        match self.0.iter_mut().find(|n| n.text == text) {
            Some(note) => note.count += count,
            None => self.0.push(ReadNote { text: text.to_owned(), count }),
        }
    }

    /// The notes, in the order in which they came up.
    pub(super) fn into_vec(self) -> Vec<ReadNote> {
        self.0
    }
}
