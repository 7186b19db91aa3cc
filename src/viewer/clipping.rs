//! The part of a mesh in the clipping box, cut beside the window.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::error::{Error, Result};
use crate::space::Bounds;
use crate::tet::TetMesh;

/// What is drawn of a mesh.
pub struct Part {
    /// The mesh, or what a box leaves of it.
    pub mesh: Arc<TetMesh>,
    /// It is what was asked for: nothing better follows.
    pub is_last: bool,
}

/// A box that is being cut to.
struct Running {
    bounds: Bounds,
    result: Receiver<Result<TetMesh>>,
}

/// Cuts, one box at a time: while a side is pulled, the newest box once the last one is done.
#[derive(Default)]
pub struct Clipper {
    /// The last box that was cut to, and what it left; what there was before, where it left nothing.
    last: Option<(Bounds, Arc<TetMesh>)>,
    running: Option<Running>,
}

impl Clipper {
    /// What is in `clip` of `whole` (which fills `all`), or what is there meanwhile; `wake` is called when there is something else.
    ///
    /// # Errors
    /// Once for each box that leaves nothing.
    pub fn part(
        &mut self,
        whole: &Arc<TetMesh>,
        all: &Bounds,
        clip: Option<Bounds>,
        wake: impl FnOnce() + Send + 'static,
    ) -> Result<Part> {
        let cuts = |clip: &Bounds| clip.min.cmpgt(all.min).any() || clip.max.cmplt(all.max).any();
        let Some(clip) = clip.filter(cuts) else {
            *self = Self::default();
            return Ok(Part { mesh: Arc::clone(whole), is_last: true });
        };
        let now = || self.last.as_ref().map_or_else(|| Arc::clone(whole), |(_, mesh)| Arc::clone(mesh));
        let mut failed = None;
        if let Some(running) = &self.running {
            let mesh = match running.result.try_recv() {
                Err(TryRecvError::Empty) => return Ok(Part { mesh: now(), is_last: false }),
                Ok(Ok(mesh)) => Arc::new(mesh),
                Ok(Err(error)) => {
                    failed = Some(error);
                    now()
                }
                Err(TryRecvError::Disconnected) => {
                    failed = Some(Error::Mesh("cutting the mesh ended without a result".into()));
                    now()
                }
            };
            self.last = Some((running.bounds, mesh));
            self.running = None;
        }
        if let Some(error) = failed {
            return Err(error);
        }
        if let Some((bounds, mesh)) = &self.last
            && *bounds == clip
        {
            return Ok(Part { mesh: Arc::clone(mesh), is_last: true });
        }
        let mesh = self.last.as_ref().map_or_else(|| Arc::clone(whole), |(_, mesh)| Arc::clone(mesh));
        let (sender, result) = channel();
        let source = Arc::clone(whole);
        std::thread::spawn(move || {
            // The window may have been closed.
            let _ = sender.send(source.clipped_to(&clip));
            wake();
        });
        self.running = Some(Running { bounds: clip, result });
        Ok(Part { mesh, is_last: false })
    }
}
