//! What several test files need.
#![allow(dead_code, reason = "every test file uses a part of it")]

pub mod agreement;
pub mod boxes;
pub mod delaunay;
pub mod gpu;
pub mod held_out;
pub mod integral_scene;
pub mod meshes;
pub mod npy;
pub mod peer_scene;
pub mod rainbow;
pub mod random;
pub mod views;

use std::path::PathBuf;

/// The folder that an environment variable names; tests that need it are left out unless asked for.
pub fn folder(variable: &str) -> PathBuf {
    match std::env::var_os(variable) {
        Some(folder) => folder.into(),
        None => panic!("set {variable} to the folder that this test reads (it is ignored by default)"),
    }
}
