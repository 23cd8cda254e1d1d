//! Writing a file whole or not at all: the door to tempfile.

use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Where an output path leads.
#[derive(Debug, PartialEq, Eq)]
pub enum Target {
    /// A regular file, there or not yet; symbolic links are followed.
    File(PathBuf),
    /// A device, a pipe or a terminal: written in place, since it cannot be replaced.
    Stream,
    /// A folder.
    Folder,
}

/// Why nothing can be written to a path. Each text names the path as it was given.
#[derive(Debug, thiserror::Error)]
pub enum Unwritable {
    /// The folder to write into is missing.
    #[error("cannot write '{}': there is no folder '{}'", path.display(), folder.display())]
    NoFolder {
        /// The file to be written.
        path: PathBuf,
        /// The missing folder.
        folder: PathBuf,
    },
    /// The output is a folder.
    #[error("cannot write '{}': it is a folder", .0.display())]
    IsFolder(PathBuf),
    /// The output exists and is protected.
    #[error("cannot write '{}': the file is read-only", .0.display())]
    ReadOnly(PathBuf),
    /// The system refused.
    #[error("cannot write '{}'", path.display())]
    Refused {
        /// The file to be written.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl Unwritable {
    /// The system's refusal to write to `path`.
    pub fn refused(path: &Path, source: io::Error) -> Self {
        Self::Refused { path: path.to_owned(), source }
    }
}

/// Makes sure that a file can be written to `path`: the folder is there and can be written to,
/// and no old file is protected. The file itself is not touched.
///
/// # Errors
/// [`Unwritable`].
pub fn check(path: &Path) -> Result<(), Unwritable> {
    match target(path).map_err(|source| Unwritable::refused(path, source))? {
        Target::Folder => Err(Unwritable::IsFolder(path.to_owned())),
        Target::Stream => Ok(()),
        Target::File(real) => check_file(path, &real),
    }
}

/// `path` is as the user wrote it, `real` with symbolic links resolved.
fn check_file(path: &Path, real: &Path) -> Result<(), Unwritable> {
    let folder = folder_of(real);
    if !folder.is_dir() {
        return Err(Unwritable::NoFolder { path: path.to_owned(), folder: folder.to_owned() });
    }
    if fs::metadata(real).is_ok_and(|meta| meta.permissions().readonly()) {
        return Err(Unwritable::ReadOnly(path.to_owned()));
    }
    // Trying is the only test that knows about owners, quotas and read-only media.
    temporary_in(folder).map(drop).map_err(|source| Unwritable::refused(path, source))
}

/// Finds out what `path` leads to.
///
/// # Errors
/// If the system cannot say, or symbolic links form a loop.
pub fn target(path: &Path) -> io::Result<Target> {
    match fs::metadata(path) {
        Ok(meta) if meta.is_dir() => Ok(Target::Folder),
        Ok(meta) if !meta.is_file() || is_descriptor(path) => Ok(Target::Stream),
        Ok(_) => fs::canonicalize(path).map(Target::File),
        Err(error) if error.kind() == io::ErrorKind::NotFound => follow_dangling(path).map(Target::File),
        Err(error) => Err(error),
    }
}

/// `/dev/stdout` and its like stay streams when the shell has sent them to a regular file.
fn is_descriptor(path: &Path) -> bool {
    path.starts_with("/dev") || path.starts_with("/proc/self/fd")
}

/// The name that a link to nothing (yet) stands for, so that writing makes that file and keeps
/// the link.
fn follow_dangling(path: &Path) -> io::Result<PathBuf> {
    const LONGEST_CHAIN: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..LONGEST_CHAIN {
        match fs::read_link(&path) {
            Ok(next) => path = folder_of(&path).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// The folder that holds `path`; `.` for a bare name.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// One name for every spelling of a file's name (`a.tga`, `./a.tga`, a link to it), also if only
/// its folder is there yet.
pub fn place(path: &Path) -> PathBuf {
    let in_folder = || Some(folder_of(path).canonicalize().ok()?.join(path.file_name()?));
    path.canonicalize().ok().or_else(in_folder).unwrap_or_else(|| path.to_owned())
}

/// Writes `bytes` under a temporary name beside `path` and renames it, so that a failure leaves
/// the old file, or none. The new file has the old one's permissions, else the usual ones.
///
/// # Errors
/// Whatever the system reports; the temporary file is gone then.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    match target(path)? {
        Target::Folder => Err(io::ErrorKind::IsADirectory.into()),
        // Appending leaves alone what a redirected stream already holds.
        Target::Stream => OpenOptions::new().append(true).open(path)?.write_all(bytes),
        Target::File(real) => {
            let mut temporary = temporary_in(folder_of(&real))?;
            temporary.write_all(bytes)?;
            if let Ok(old) = fs::metadata(&real) {
                temporary.as_file().set_permissions(old.permissions())?;
            }
            temporary.persist(&real)?;
            Ok(())
        }
    }
}

/// A new file in `folder` under a name of its own, removed again when dropped.
///
/// # Errors
/// If no file can be made there.
fn temporary_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".raysteps-").suffix(".part");
    // Temporary files are private by default; a picture should get what the umask allows.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}
