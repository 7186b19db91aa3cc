//! In which order a frame's cells are drawn: what the device needs to know for it.

use std::cell::OnceCell;

use crate::gpu::device::Gpu;
use crate::gpu::store::{Pieces, Store};
use crate::plan::near::NearCut;
use crate::plan::order::{self, Inversions, PowerCensus, PowerOrder, Sequenced};
use crate::renderer::{Frame, OrderChoice, OrderMethod, Settings};
use crate::scene::Camera;
use crate::tet::{Adjacency, TetMesh};

/// Where `keys.wgsl` takes sort keys from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keys {
    /// The view depth of the centroid.
    Centroid,
    /// A row a cell.
    Power,
    /// A rank a cell, made on the host for one camera.
    Ranks,
}

impl Keys {
    /// All, by number.
    pub const ALL: [Self; 3] = [Self::Centroid, Self::Power, Self::Ranks];

    /// As the shader numbers them.
    pub fn constant(self) -> (&'static str, f64) {
        ("KEYS", f64::from(self as u8))
    }
}

/// What is known of a mesh's order, found when first needed.
#[derive(Default)]
pub struct Ordering {
    /// The mesh's, data units.
    diagonal: OnceCell<f64>,
    adjacency: OnceCell<Adjacency>,
    census: OnceCell<PowerCensus>,
    power: OnceCell<PowerOrder>,
    /// Of what the device's ranks are.
    ranked: Option<Ranked>,
}

#[derive(Clone, PartialEq)]
struct Ranked {
    method: OrderMethod,
    camera: Camera,
    /// Rays depend on it.
    size: [u32; 2],
    cycles: u64,
}

impl Ordering {
    fn adjacency(&self, mesh: &TetMesh) -> &Adjacency {
        self.adjacency.get_or_init(|| Adjacency::new(mesh))
    }

    fn census(&self, mesh: &TetMesh) -> &PowerCensus {
        self.census.get_or_init(|| PowerCensus::new(mesh, self.adjacency(mesh)))
    }

    fn power(&self, mesh: &TetMesh) -> &PowerOrder {
        self.power.get_or_init(|| PowerOrder::new(mesh, &self.census(mesh).metric))
    }

    /// The order of a frame, and why.
    pub fn choose(&self, mesh: &TetMesh, settings: &Settings, frame: &Frame<'_>) -> OrderChoice {
        let diagonal = *self.diagonal.get_or_init(|| mesh.bounds_in_data().diagonal());
        OrderChoice::new(settings, frame.transfer, frame.optics, diagonal, || self.census(mesh))
    }

    /// Puts on the device what keys are made of.
    pub fn prepare(
        &mut self,
        gpu: &Gpu,
        store: &mut Store,
        mesh: &TetMesh,
        method: OrderMethod,
        frame: &Frame<'_>,
        near: Option<(&NearCut, Pieces)>,
    ) -> Keys {
        // Where all that is clipped lies outside the picture, no piece is left, and no room was made for any.
        let near = near.filter(|(cut, _)| !cut.tets.is_empty());
        match (method, near) {
            (OrderMethod::Power, None) => {
                if store.needs_power_rows() {
                    store.put_power_rows(gpu, &self.power(mesh).rows_f32());
                }
                Keys::Power
            }
            (OrderMethod::Power | OrderMethod::Mpvonc | OrderMethod::Exact, _) => {
                self.rank(gpu, store, mesh, method, frame, near);
                Keys::Ranks
            }
            _ => Keys::Centroid,
        }
    }

    fn rank(
        &mut self,
        gpu: &Gpu,
        store: &mut Store,
        mesh: &TetMesh,
        method: OrderMethod,
        frame: &Frame<'_>,
        near: Option<(&NearCut, Pieces)>,
    ) {
        let (camera, size) = (*frame.camera, frame.size);
        let same = |r: &Ranked| (r.method, r.camera, r.size) == (method, camera, size);
        if !store.needs_ranks() && self.ranked.as_ref().is_some_and(same) {
            return;
        }
        let Sequenced { order, cycles } = match method {
            OrderMethod::Power => Sequenced { order: self.power(mesh).order(mesh, &camera), cycles: 0 },
            OrderMethod::Mpvonc => order::mpvonc(mesh, self.adjacency(mesh), &camera),
            _ => order::exact(mesh, self.adjacency(mesh), &camera, size),
        };
        let ranks = match near {
            None => order.ranks(),
            Some((cut, pieces)) => order::ranks_with_pieces(&order, mesh, cut, &camera, pieces.range.first as usize),
        };
        store.put_ranks(gpu, &ranks);
        self.ranked = Some(Ranked { method, camera, size, cycles });
    }

    /// Circles of cells that the last ranks had to break.
    pub fn cycles(&self, method: OrderMethod) -> u64 {
        self.ranked.as_ref().filter(|r| r.method == method).map_or(0, |r| r.cycles)
    }

    /// How many neighbours among the drawn cells, back to front, are in the wrong order.
    pub fn inversions(&self, mesh: &TetMesh, camera: &Camera, drawn: &[u32]) -> Inversions {
        Inversions::of_drawn(mesh, self.adjacency(mesh), camera, drawn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gpu::shader::Module;

    #[test]
    fn the_shader_has_the_same_numbers() {
        let module = Module::new("keys").expect("a pass").naga;
        let value = |name: &str| {
            let constant = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name)).expect(name).1;
            match module.global_expressions[constant.init] {
                naga::Expression::Literal(naga::Literal::U32(value)) => f64::from(value),
                ref other => panic!("{name}: {other:?}"),
            }
        };
        assert_eq!(Keys::Centroid.constant().1, value("BY_CENTROID"));
        assert_eq!(Keys::Power.constant().1, value("BY_POWER"));
        assert!(Keys::ALL.iter().enumerate().all(|(i, keys)| keys.constant().1 == i as f64));
    }
}
