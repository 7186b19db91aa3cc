//! Where a run happens, and what the process has used of it.

use std::path::Path;
use std::process::Command;
use std::time::Duration;

use crate::report::record::Machine;

/// This machine; `folder`: of the source whose commit is told, unless `TETRALUX_COMMIT` tells it.
pub(super) fn this_machine(folder: &Path, adapter: &str) -> Machine {
    let known = sysinfo::System::new_with_specifics(
        sysinfo::RefreshKind::nothing()
            .with_cpu(sysinfo::CpuRefreshKind::nothing())
            .with_memory(sysinfo::MemoryRefreshKind::nothing().with_ram()),
    );
    let processor = known.as_ref().ok().and_then(|system| system.cpus().first());
    Machine {
        processor: processor.map(|cpu| cpu.brand().trim().to_owned()).unwrap_or_default(),
        threads: std::thread::available_parallelism().map_or(1, usize::from),
        memory_bytes: known.as_ref().map_or(0, sysinfo::System::total_memory),
        system: sysinfo::System::long_os_version().unwrap_or_default(),
        adapter: adapter.to_owned(),
        commit: std::env::var("TETRALUX_COMMIT").ok().or_else(|| commit(folder)).unwrap_or_else(|| "unknown".into()),
    }
}

/// What git says of the source: its commit, and `-dirty` where files were changed.
fn commit(folder: &Path) -> Option<String> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let described = Command::new("git")
        .arg("-C")
        .arg(folder)
        .args(["describe", "--always", "--dirty", "--abbrev=12", "--exclude=*"])
        .output()
        .ok()?;
    let text = String::from_utf8(described.stdout).ok()?.trim().to_owned();
    (described.status.success() && !text.is_empty()).then_some(text)
}

/// What the process has used so far: time of all its threads, and the most memory it held, bytes.
#[cfg(unix)]
pub(super) fn used() -> Option<(Duration, u64)> {
    use nix::sys::resource::{UsageWho, getrusage};
    use nix::sys::time::TimeValLike as _;
    let usage = getrusage(UsageWho::RUSAGE_SELF).ok()?;
    let micros = (usage.user_time() + usage.system_time()).num_microseconds();
    // Linux counts KiB, macOS bytes.
    let unit = if cfg!(target_os = "macos") { 1 } else { 1024 };
    Some((Duration::from_micros(micros.try_into().ok()?), u64::try_from(usage.max_rss()).ok()? * unit))
}

/// Nothing that is known here.
#[cfg(not(unix))]
pub(super) fn used() -> Option<(Duration, u64)> {
    None
}
