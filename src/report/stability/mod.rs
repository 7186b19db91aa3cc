//! The stability suite: scenes in which renderers go wrong, each a sweep of one number to its extremes, and every method's
//! picture held to a truth.
//!
//! A [`Case`] makes a [`Setup`] of each of its values; a [`Trial`] is one with its true picture; an [`Entrant`] draws it, and
//! [`Trial::judge`] gives the [`Outcome`]. Where a method is known to degrade or to refuse, the case says by how much and
//! why ([`Known`]): what is worse than that fails, and `docs/stability.md` shows it.

pub mod cases;
mod entrant;
mod judge;
mod run;
mod scenery;

use std::sync::Arc;

pub use entrant::Entrant;
pub use judge::{Limits, Outcome, PASS, Verdict};
pub use run::{Row, Trial, entrants, run, worst};

use crate::error::Result;
use crate::renderer::Frame;
use crate::scene::{Camera, Optics, TransferFunction};
use crate::space::Ray;
use crate::tet::TetMesh;

/// A mesh under a function from a place.
#[derive(Clone, Debug)]
pub struct Shot {
    /// What is drawn.
    pub mesh: Arc<TetMesh>,
    /// From where.
    pub camera: Camera,
    /// Classification, data units.
    pub transfer: TransferFunction,
    /// Width and height, pixels.
    pub size: [u32; 2],
}

impl Shot {
    /// Unlit, before nothing.
    pub fn frame(&self) -> Frame<'_> {
        let (camera, transfer) = (&self.camera, &self.transfer);
        Frame { camera, transfer, optics: &Optics::PLAIN, size: self.size, background: [0.0; 4] }
    }
}

/// Linear premultiplied colour and opacity of a ray, data units.
pub type Formula = Box<dyn Fn(&Ray) -> [f64; 4]>;

/// What a picture is held to.
pub enum Truth {
    /// The f64 reference of the same.
    Reference,
    /// The f64 reference of the same thing told in other words: in plain units, say, or before cells were cut.
    Same(Shot),
    /// Known in closed form.
    Formula(Formula),
}

/// What a case makes of one of its values.
pub struct Setup {
    /// What is drawn.
    pub shot: Shot,
    /// What it should be.
    pub truth: Truth,
}

impl From<Shot> for Setup {
    /// Held to its own reference.
    fn from(shot: Shot) -> Self {
        Self { shot, truth: Truth::Reference }
    }
}

/// What is known of some entrants at some values of a case.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Their names.
    pub entrants: &'static [&'static str],
    /// First and last of the values.
    pub values: [f64; 2],
    /// What they are allowed.
    pub expected: Expected,
    /// For people.
    pub why: &'static str,
}

/// What is allowed beyond [`PASS`].
#[derive(Clone, Copy, Debug)]
pub enum Expected {
    /// To err within these.
    Degrades(Limits),
    /// To draw a picture in which what matters is missing.
    Misses,
    /// To draw nothing, and to say why.
    Refuses,
}

/// A sweep of one number.
#[derive(Clone, Copy)]
pub struct Case {
    /// Lower case, with hyphens.
    pub name: &'static str,
    /// What the number is.
    pub parameter: &'static str,
    /// Of the number, in order.
    pub values: &'static [f64],
    /// What each makes.
    pub make: fn(f64) -> Result<Setup>,
    /// Which integrals beside the default take part.
    pub integrals: &'static [&'static str],
    /// Where methods are allowed to be worse than [`PASS`].
    pub known: &'static [Known],
}

impl Case {
    /// What is known of an entrant at a value.
    pub fn known(&self, entrant: &str, value: f64) -> Option<&Known> {
        let holds = |known: &&Known| known.values[0] <= value && value <= known.values[1];
        self.known.iter().find(|known| holds(known) && known.entrants.contains(&entrant))
    }
}
