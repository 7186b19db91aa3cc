//! Where results go: checked before the work starts, written whole or not at all.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::error::{Error, Result};

/// Held while files are written.
static WRITING: Mutex<()> = Mutex::new(());

/// What a shell expects of a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// From now on Ctrl-C waits for files that are being written: none is left in parts, nor under a temporary name.
pub(crate) fn end_whole() {
    // Without a handler the system's default remains.
    let _ = ctrlc::set_handler(|| {
        let _written = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
        std::process::exit(INTERRUPTED);
    });
}

/// Writes files by `write`, whatever is pressed meanwhile.
pub(crate) fn whole<T>(write: impl FnOnce() -> T) -> T {
    let _writing = WRITING.lock().unwrap_or_else(PoisonError::into_inner);
    write()
}

/// Refuses a picture that could not be written: an unknown extension, a folder that is not there or cannot be written.
pub(crate) fn check_picture(path: &Path) -> Result<()> {
    check_file(path, &["png", "exr"])
}

/// The same for a file with one of these extensions.
pub(crate) fn check_file(path: &Path, extensions: &[&str]) -> Result<()> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !extensions.contains(&extension.as_str()) {
        let known = extensions.iter().map(|e| format!(".{e}")).collect::<Vec<_>>().join(" or ");
        return Err(Error::Asked(format!("the output's name must end in {known}: {}", path.display())));
    }
    if path.is_dir() {
        return Err(Error::write(path, "a folder has this name"));
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        return Err(Error::write(path, "its folder does not exist; make it first"));
    }
    // Asking the system is not enough (read-only mounts, quotas): make a file and drop it.
    tempfile::tempfile_in(folder).map_err(|e| Error::write(path, format!("no file can be made in its folder: {e}")))?;
    Ok(())
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes a text file whole or not at all.
pub(crate) fn write_whole(path: &Path, text: &str) -> Result<()> {
    whole(|| stage(path, text.as_bytes())?.persist(path).map_err(|e| Error::write(path, e.error)))?;
    Ok(())
}

/// Writes several files, each whole or not at all; none where one of them does not fit or cannot be made.
pub(crate) fn write_together(files: &[(PathBuf, Vec<u8>)]) -> Result<()> {
    if let Some((path, _)) = files.iter().find(|(path, _)| path.is_dir()) {
        return Err(Error::write(path, "a folder has this name"));
    }
    whole(|| {
        let staged = files.iter().map(|(path, bytes)| stage(path, bytes)).collect::<Result<Vec<_>>>()?;
        for (file, (path, _)) in staged.into_iter().zip(files) {
            file.persist(path).map_err(|e| Error::write(path, e.error))?;
        }
        Ok(())
    })
}

/// The contents under a temporary name beside the file, removed if it goes no further.
fn stage(path: &Path, contents: &[u8]) -> Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // The user's umask decides, as for any other file; temporary files are private by default.
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder_of(path)).map_err(|e| Error::write(path, e))?;
    file.write_all(contents).map_err(|e| Error::write(path, e))?;
    Ok(file)
}

/// Prints to stdout. A closed pipe comes back as an error that `main` takes for the end.
pub(crate) fn say(text: &str) -> std::io::Result<()> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes())?;
    if !text.ends_with('\n') {
        out.write_all(b"\n")?;
    }
    out.flush()
}

/// Tells something beside the result, on stderr.
pub(crate) fn note(text: &str) {
    // Where stderr is closed there is nobody to tell.
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}
