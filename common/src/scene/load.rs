//! Reading a scene file and the meshes it names.

use super::Scene;
use super::diagnostic::{Fault, SceneError};
use super::lexer::Span;
use super::parse::parse;
use super::suggest::nearest;
use crate::mesh::{Mesh, MeshError, read_obj};
use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Largest scene file that is read, in bytes: a thousand times what any person writes.
const MOST_BYTES: u64 = 256 << 20;

/// Where meshes and pictures come from while a scene is parsed: the file system, or a test's
/// table.
pub trait MeshSource {
    /// The mesh that `name` (as written in the scene) stands for. The same file should give
    /// clones of the same `Arc`, which the scene then stores once.
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError>;

    /// The file that a picture's `name` stands for, or a message why there is none. The picture
    /// itself is read by who needs it.
    fn picture(&mut self, name: &str) -> Result<PathBuf, String> {
        Ok(PathBuf::from(name))
    }
}

/// Every name stands for this mesh.
impl MeshSource for Arc<Mesh> {
    fn mesh(&mut self, _: &str) -> Result<Arc<Mesh>, MeshError> {
        Ok(Arc::clone(self))
    }
}

/// Reads a scene file with its meshes; see [`parse_str`].
///
/// Names of meshes and pictures are looked up relative to the scene file's folder first, then
/// relative to the working directory. A mesh file is read once, however often and under
/// whatever names the scene mentions it.
///
/// # Errors
/// If the file cannot be read, is larger than 256 MiB, is not UTF-8 or not a scene, or
/// if a mesh it names cannot be read or a picture it names is not there.
pub fn load(path: &Path) -> Result<Scene, SceneError> {
    load_sharing(path, true)
}

/// The same; without `sharing` a mesh file is read as often as the scene mentions it, and the
/// scene keeps every copy. Takes longer, and changes nothing else.
///
/// # Errors
/// Those of [`load`].
pub fn load_sharing(path: &Path, sharing: bool) -> Result<Scene, SceneError> {
    let name = path.display().to_string();
    let bytes = read(path).map_err(|error| unreadable(path, &error))?;
    let text = decode(&name, bytes)?;
    parse_str(&name, &text, &mut Folder::of(path, sharing))
}

/// Parses the text of a scene file; `name` is used in error messages.
///
/// # Errors
/// If the text is not a scene; the error names the first place where that shows.
pub fn parse_str(name: &str, text: &str, meshes: &mut dyn MeshSource) -> Result<Scene, SceneError> {
    parse(text, meshes).map_err(|fault| fault.into_error(name, text))
}

fn read(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    if file.metadata()?.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let mut bytes = Vec::new();
    // One byte more than allowed tells a file that is too large from one that just fits, even
    // if it is a pipe whose length nobody knows.
    file.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > MOST_BYTES {
        true => Err(io::ErrorKind::FileTooLarge.into()),
        false => Ok(bytes),
    }
}

fn unreadable(path: &Path, error: &io::Error) -> SceneError {
    let name = path.display().to_string();
    let mut help = None;
    let message = match error.kind() {
        io::ErrorKind::NotFound => {
            help = similar_name(path).map(|name| format!("did you mean `{name}`?"));
            "there is no such scene file".to_owned()
        }
        io::ErrorKind::IsADirectory => "this is a folder, not a scene file".to_owned(),
        io::ErrorKind::FileTooLarge => {
            format!("this file is larger than {} MiB; is it a scene?", MOST_BYTES >> 20)
        }
        _ => format!("cannot read the scene file: {error}"),
    };
    SceneError::of_file(&name, message, help)
}

/// The file in the same folder whose name is most like that of the missing one.
fn similar_name(missing: &Path) -> Option<String> {
    let folder = match missing.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let names: Vec<String> =
        fs::read_dir(folder).ok()?.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    let wanted = missing.file_name()?.to_str()?;
    let best = nearest(wanted, names.iter().map(String::as_str))?;
    Some(missing.with_file_name(best).display().to_string())
}

fn decode(name: &str, bytes: Vec<u8>) -> Result<String, SceneError> {
    String::from_utf8(bytes).map_err(|error| {
        let start = error.utf8_error().valid_up_to();
        let byte = error.as_bytes()[start];
        // Only the faulty sequence is replaced by U+FFFD, so offsets before it stay.
        let text = String::from_utf8_lossy(error.as_bytes());
        let span = Span::from(start..start + char::REPLACEMENT_CHARACTER.len_utf8());
        Fault::new(span, format!("byte {byte:#04x} is not UTF-8 text"))
            .help("save the file as UTF-8, or check that it is a scene file at all")
            .into_error(name, &text)
    })
}

/// The file system, seen from a scene file's folder.
struct Folder {
    folder: PathBuf,
    /// Whether what was read is given again.
    sharing: bool,
    by_name: HashMap<String, Arc<Mesh>>,
    by_file: HashMap<PathBuf, Arc<Mesh>>,
}

impl Folder {
    fn of(scene: &Path, sharing: bool) -> Self {
        Self {
            sharing,
            folder: scene.parent().unwrap_or(Path::new("")).to_owned(),
            by_name: HashMap::new(),
            by_file: HashMap::new(),
        }
    }

    /// The existing file that `name` stands for.
    fn resolve(&self, name: &str) -> Result<PathBuf, String> {
        let beside_scene = self.folder.join(name);
        if beside_scene.is_file() {
            return Ok(beside_scene);
        }
        let in_working_directory = PathBuf::from(name);
        if in_working_directory.is_file() {
            return Ok(in_working_directory);
        }
        let suggestion =
            similar_name(&beside_scene).map(|name| format!("; did you mean `{name}`?")).unwrap_or_default();
        let name = name.escape_debug();
        Err(format!("there is no file `{name}` beside the scene or in the working directory{suggestion}"))
    }
}

impl MeshSource for Folder {
    fn mesh(&mut self, name: &str) -> Result<Arc<Mesh>, MeshError> {
        if let Some(mesh) = self.by_name.get(name) {
            return Ok(Arc::clone(mesh));
        }
        let path = self.resolve(name).map_err(MeshError::new)?;
        if !self.sharing {
            return Ok(Arc::new(read_obj(&path)?));
        }
        let key = path.canonicalize().unwrap_or_else(|_| path.clone());
        let mesh = match self.by_file.get(&key) {
            Some(mesh) => Arc::clone(mesh),
            None => Arc::new(read_obj(&path)?),
        };
        self.by_file.insert(key, Arc::clone(&mesh));
        self.by_name.insert(name.to_owned(), Arc::clone(&mesh));
        Ok(mesh)
    }

    fn picture(&mut self, name: &str) -> Result<PathBuf, String> {
        self.resolve(name)
    }
}
