//! Where a scene meets a mesh: fitted cameras, normalised units, and the function of a scene that names none.

use super::camera::Camera;
use super::choice::Scene;
use super::suggest::suggest;
use super::transfer::TransferFunction;
use crate::error::Result;
use crate::tet::Domain;

impl Scene {
    /// Camera and transfer function for `mesh`, both in data units.
    ///
    /// # Errors
    /// [`crate::Error::Asked`] where the camera looks nowhere (its eye at the mesh's centre, say).
    pub fn resolve(&self, mesh: &(impl Domain + ?Sized)) -> Result<(Camera, TransferFunction)> {
        let bounds = mesh.bounds_in_data();
        let camera = self.camera.resolve(&bounds, f64::from(self.size[0]) / f64::from(self.size[1]))?;
        let transfer = match &self.transfer {
            Some(choice) => choice.resolve(mesh.scalar_range(), mesh.gradient_range()),
            None => suggest(mesh, &mesh.histogram([256, 256])),
        };
        Ok((camera, transfer))
    }
}
