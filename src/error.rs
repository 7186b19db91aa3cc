//! The library's error type: every message says what failed, why, and what to do; the path comes last.

use std::path::{Path, PathBuf};

/// Result of every fallible library call.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// What can go wrong, by who can mend it.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file could not be opened, mapped or read at all.
    #[error("cannot read: {source}: {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// The system's answer.
        source: std::io::Error,
    },
    /// A file was read and is not what it should be. `what` names the place (line, byte, array, cell) where known.
    #[error("{what}: {}", path.display())]
    Malformed {
        /// What is wrong, where, and what to do.
        what: String,
        /// The file.
        path: PathBuf,
    },
    /// The mesh cannot be rendered (no volume cells, no such field, ...).
    #[error("{0}")]
    Mesh(String),
    /// What was asked for does not make sense (a scene key, a field's name, a flag's value).
    #[error("{0}")]
    Asked(String),
    /// The graphics device refused or lacks something.
    #[error("{0}")]
    Device(String),
    /// A result could not be written.
    #[error("cannot write: {what}: {}", path.display())]
    Write {
        /// Why.
        what: String,
        /// The file that was to be made.
        path: PathBuf,
    },
}

impl Error {
    /// A malformed file.
    pub fn malformed(path: &Path, what: impl Into<String>) -> Self {
        Self::Malformed { what: what.into(), path: path.to_owned() }
    }

    /// An unreadable file.
    pub fn io(path: &Path, source: std::io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    /// A file that could not be written.
    pub fn write(path: &Path, what: impl std::fmt::Display) -> Self {
        Self::Write { what: what.to_string(), path: path.to_owned() }
    }

    /// 2 where the user asked for something impossible, 1 for everything else.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Asked(_) => 2,
            _ => 1,
        }
    }
}
