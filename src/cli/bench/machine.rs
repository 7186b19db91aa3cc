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
    Some((Duration::from_micros(micros.try_into().ok()?), most_held(usage.max_rss())?))
}

/// Linux goes on counting where one program takes another one's place, but for this.
#[cfg(target_os = "linux")]
fn most_held(_: i64) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(1024 * line.trim().trim_end_matches("kB").trim().parse::<u64>().ok()?)
}

/// macOS counts bytes, others KiB.
#[cfg(all(unix, not(target_os = "linux")))]
fn most_held(counted: i64) -> Option<u64> {
    let unit = if cfg!(target_os = "macos") { 1 } else { 1024 };
    Some(u64::try_from(counted).ok()? * unit)
}

/// Goes on with the same command in a process of its own where this one has come to hold half of the memory: lavapipe
/// keeps most of what it drew with until the process ends, whatever becomes of its devices.
///
/// # Errors
/// The program cannot be started again.
#[cfg(target_os = "linux")]
pub(super) fn go_on_afresh(machine: &Machine) -> std::io::Result<()> {
    use std::os::unix::process::CommandExt as _;
    let held = used().map_or(0, |(_, bytes)| bytes);
    // Of a source with changes all would be measured again.
    if held < machine.memory_bytes / 2 || machine.memory_bytes == 0 || machine.commit.ends_with("-dirty") {
        return Ok(());
    }
    Err(Command::new(std::env::current_exe()?).args(std::env::args_os().skip(1)).exec())
}

/// Other systems have no lavapipe.
#[cfg(not(target_os = "linux"))]
pub(super) fn go_on_afresh(_: &Machine) -> std::io::Result<()> {
    Ok(())
}

/// Nothing that is known here.
#[cfg(not(unix))]
pub(super) fn used() -> Option<(Duration, u64)> {
    None
}
