//! Shader sources: embedded, joined by `#import`, parsed once for their bindings.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use crate::error::{Error, Result};

macro_rules! sources {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../../shaders/", $name, ".wgsl")))),*]
    };
}

/// Every shader file, by its path below `shaders/` without the ending.
const SOURCES: &[(&str, &str)] = sources![
    "candidates",
    "compact",
    "compose",
    "cull",
    "faces",
    "grid_bricks",
    "grid_candidates",
    "grid_cast",
    "grid_cull",
    "grid_list",
    "grid_marks",
    "grid_near",
    "grid_project",
    "keys",
    "layers",
    "list_rows",
    "listed",
    "math/optics",
    "math/psi",
    "math/ramp",
    "math/real",
    "math/shade",
    "math/turns",
    "math/unweighted",
    "math/waves",
    "math/widget",
    "occupied",
    "preintegrate",
    "project",
    "psi_table",
    "raster",
    "raycast",
    "raylist",
    "resolve",
    "segments",
    "shared/adaptive",
    "shared/bands",
    "shared/bound",
    "shared/corners",
    "shared/counts",
    "shared/covered",
    "shared/curves",
    "shared/frame",
    "shared/grid",
    "shared/grid_bound",
    "shared/grid_cells",
    "shared/integrals",
    "shared/light",
    "shared/linked",
    "shared/lists",
    "shared/mesh_cells",
    "shared/outlines",
    "shared/points",
    "shared/range",
    "shared/ray",
    "shared/reached",
    "shared/scan",
    "shared/special",
    "shared/table",
    "shared/tets",
    "shared/transfer",
    "shared/visible",
    "shared/walk",
    "shared/widgets",
    "sort_count",
    "sort_scan",
    "sort_scatter",
    "vertices",
];

/// The files that are passes: those that are not imported by others.
pub fn pass_names() -> impl Iterator<Item = &'static str> {
    SOURCES.iter().map(|(name, _)| *name).filter(|name| !name.contains('/'))
}

/// The pass's source with every `#import NAME` line replaced by that file, each file once.
///
/// # Errors
/// An unknown name.
pub fn compose(name: &str) -> Result<String> {
    let mut text = String::new();
    append(name, &mut Vec::new(), &mut text)?;
    Ok(text)
}

fn append(name: &str, done: &mut Vec<String>, text: &mut String) -> Result<()> {
    if done.iter().any(|d| d == name) {
        return Ok(());
    }
    done.push(name.to_owned());
    let (_, source) = SOURCES
        .iter()
        .find(|(known, _)| *known == name)
        .ok_or_else(|| Error::Device(format!("there is no shader file named '{name}'")))?;
    for line in source.lines() {
        match line.strip_prefix("#import ") {
            Some(import) => append(import.trim(), done, text)?,
            None => {
                text.push_str(line);
                text.push('\n');
            }
        }
    }
    Ok(())
}

/// What a module binds where, as naga sees it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Binding {
    /// The variable's name.
    pub name: String,
    /// Bind group.
    pub group: u32,
    /// Index in the group.
    pub index: u32,
    /// Buffer or texture, and how it is accessed.
    pub kind: BindingKind,
    /// Entry points that use it.
    pub stages: wgpu::ShaderStages,
}

/// The kinds of bindings that the shaders use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BindingKind {
    /// `var<uniform>`.
    Uniform,
    /// `var<storage, read>`.
    Read,
    /// `var<storage, read_write>`.
    ReadWrite,
    /// `texture_2d<f32>`, loaded without filtering.
    Texture,
    /// `texture_storage_2d<rgba32float, write>`.
    WriteTexture,
}

/// A composed, validated shader.
pub struct Module {
    /// The pass's name.
    pub name: &'static str,
    /// What is handed to wgpu.
    pub source: String,
    /// Used bindings, by group and index.
    pub bindings: Vec<Binding>,
    /// Parsed form; the layout tests read struct layouts from it.
    pub naga: naga::Module,
}

impl Module {
    /// A constant that the host has, too.
    #[cfg(test)]
    pub(super) fn constant(&self, name: &str) -> u32 {
        let constant = self.naga.constants.iter().find(|(_, c)| c.name.as_deref() == Some(name)).expect(name).1;
        match self.naga.global_expressions[constant.init] {
            naga::Expression::Literal(naga::Literal::U32(value)) => value,
            ref other => panic!("{name}: {other:?}"),
        }
    }

    /// Composes, parses and validates the pass `name`.
    ///
    /// # Errors
    /// The parser's or validator's message, with the shader's name.
    pub fn new(name: &'static str) -> Result<Self> {
        let source = compose(name)?;
        let module = naga::front::wgsl::parse_str(&source)
            .map_err(|e| Error::Device(format!("shader '{name}' does not parse: {}", e.emit_to_string(&source))))?;
        let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all())
            .validate(&module)
            .map_err(|e| Error::Device(format!("shader '{name}' is not valid: {}", e.emit_to_string(&source))))?;
        let mut bindings = BTreeMap::new();
        for (handle, variable) in module.global_variables.iter() {
            let Some(place) = &variable.binding else { continue };
            let mut stages = wgpu::ShaderStages::NONE;
            for (index, entry) in module.entry_points.iter().enumerate() {
                if !info.get_entry_point(index)[handle].is_empty() {
                    stages |= match entry.stage {
                        naga::ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
                        naga::ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
                        _ => wgpu::ShaderStages::COMPUTE,
                    };
                }
            }
            if stages.is_empty() {
                continue;
            }
            let kind = match variable.space {
                naga::AddressSpace::Uniform => BindingKind::Uniform,
                naga::AddressSpace::Storage { access } if access.contains(naga::StorageAccess::STORE) => {
                    BindingKind::ReadWrite
                }
                naga::AddressSpace::Storage { .. } => BindingKind::Read,
                _ => match module.types[variable.ty].inner {
                    naga::TypeInner::Image { class: naga::ImageClass::Storage { .. }, .. } => BindingKind::WriteTexture,
                    _ => BindingKind::Texture,
                },
            };
            let name = variable.name.clone().unwrap_or_default();
            let (group, index) = (place.group, place.binding);
            if let Some(Binding { name: other, .. }) =
                bindings.insert((group, index), Binding { name: name.clone(), group, index, kind, stages })
            {
                return Err(Error::Device(format!("'{other}' and '{name}' share a binding")));
            }
        }
        Ok(Self { name, source, bindings: bindings.into_values().collect(), naga: module })
    }

    /// The same, composed once.
    ///
    /// # Errors
    /// As [`Module::new`].
    pub fn known(name: &'static str) -> Result<Arc<Self>> {
        type Known = BTreeMap<&'static str, Arc<Module>>;
        static KNOWN: Mutex<Known> = Mutex::new(BTreeMap::new());
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(module) = known.get(name) {
            return Ok(Arc::clone(module));
        }
        let module = Arc::new(Self::new(name)?);
        known.insert(name, Arc::clone(&module));
        Ok(module)
    }

    /// The size in bytes of the WGSL struct `name`, and its members' names and offsets.
    pub fn struct_layout(&self, name: &str) -> Option<(u32, Vec<(String, u32)>)> {
        self.naga.types.iter().find_map(|(_, ty)| match &ty.inner {
            naga::TypeInner::Struct { members, span } if ty.name.as_deref() == Some(name) => {
                Some((*span, members.iter().map(|m| (m.name.clone().unwrap_or_default(), m.offset)).collect()))
            }
            _ => None,
        })
    }
}
