//! What is rasterised of a cell: the one thing in which the methods that project cells differ.

use crate::renderer::Method;

/// Triangles that cover the pixels of a cell, from four corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Cover {
    /// The outline, in 1 or 2 triangles (`shared/outlines.wgsl`).
    #[default]
    Outline,
    /// The 1 to 3 front faces, and back faces that the rasteriser culls (`faces.wgsl`).
    FrontFaces,
}

impl Cover {
    /// What a method draws.
    pub fn of(method: Method) -> Self {
        if method == Method::CellCast { Self::FrontFaces } else { Self::Outline }
    }

    /// The pass that makes the corners.
    pub fn pass(self) -> &'static str {
        match self {
            Self::Outline => "project",
            Self::FrontFaces => "faces",
        }
    }

    /// Corners of a cell's triangles. The first one of each holds what is affine over it.
    pub fn triangles(self) -> &'static [u32] {
        match self {
            Self::Outline => &[0, 1, 2, 2, 3, 0],
            Self::FrontFaces => &[1, 2, 0, 2, 3, 0, 3, 1, 0],
        }
    }

    /// Indices a cell.
    pub fn indices(self) -> u32 {
        self.triangles().len() as u32
    }

    /// Which triangles the rasteriser drops. Outlines have no sides.
    pub fn culled(self) -> Option<wgpu::Face> {
        match self {
            Self::Outline => None,
            Self::FrontFaces => Some(wgpu::Face::Back),
        }
    }

    /// For people.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Outline => "outlines",
            Self::FrontFaces => "front faces",
        }
    }
}
