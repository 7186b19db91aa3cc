//! Placeholder until the merge.
use crate::report::record::Contender;
use std::path::{Path, PathBuf};
pub(super) fn picture_name(by: &Contender) -> String {
    let text = [&by.program, &by.device, &by.method, &by.integral, &by.order].map(String::as_str).join("-");
    text.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect()
}
pub(super) fn write(_: &[PathBuf], _: Option<&Path>, _: &Path) -> anyhow::Result<()> {
    Ok(())
}
