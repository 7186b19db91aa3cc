//! The mesh that is looked at, and what is known of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::cli::args::SourceArgs;
use crate::cli::load;
use crate::error::Result;
use crate::mesh::ArrayChoice;
use crate::space::Bounds;
use crate::tet::{JointHistogram, TetMesh};

/// Bins of the histogram that is drawn on.
pub const BINS: [usize; 2] = [320, 240];

/// A mesh with one field.
#[derive(Clone, Debug)]
pub struct Opened {
    /// Where it came from.
    pub path: PathBuf,
    /// What else could be drawn of it.
    pub fields: Vec<String>,
    /// The mesh.
    pub mesh: Arc<TetMesh>,
    /// Of the field; it knows the ranges of both axes.
    pub histogram: Arc<JointHistogram>,
    /// Of the mesh, data space.
    pub bounds: Bounds,
    /// What was left out or guessed.
    pub notes: Vec<String>,
}

impl Opened {
    /// Reads a file; the first field where none is named.
    ///
    /// # Errors
    /// As the command line's.
    pub fn read(path: &Path, field: Option<&str>) -> Result<Self> {
        let source = SourceArgs::of(path.to_owned());
        let read = load::mesh(&source, ArrayChoice::All)?;
        let fields = read
            .available
            .iter()
            .map(|array| if array.components == 1 { array.name.clone() } else { format!("{}:mag", array.name) })
            .collect();
        let (mesh, census) = load::cut(read, &source, field)?;
        let histogram = Arc::new(JointHistogram::new(&mesh, BINS));
        let bounds = mesh.bounds_in_data();
        Ok(Self { path: path.to_owned(), fields, mesh: Arc::new(mesh), histogram, bounds, notes: census.notes })
    }
}

/// A file that is being read, beside the window.
pub struct Loading {
    /// Which.
    pub path: PathBuf,
    result: Receiver<Result<Opened>>,
}

impl Loading {
    /// Begins; `wake` is called at the end.
    pub fn start(path: PathBuf, field: Option<String>, wake: impl FnOnce() + Send + 'static) -> Self {
        let (sender, result) = channel();
        let source = path.clone();
        std::thread::spawn(move || {
            // Nobody waits for it any more where that was cancelled.
            let _ = sender.send(Opened::read(&source, field.as_deref()));
            wake();
        });
        Self { path, result }
    }

    /// What became of it, once.
    pub fn finished(&self) -> Option<Result<Opened>> {
        match self.result.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                let text = format!("reading {} ended without a result", self.path.display());
                Some(Err(crate::Error::Device(text)))
            }
        }
    }
}
