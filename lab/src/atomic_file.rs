//! Writes result files atomically: to a temporary file, which replaces the result when it is complete.
//!
//! A run that fails or a full disk leaves the previous file unchanged, and no reader sees half a result.
//! [`write_texts`] writes several texts so, all or none.

use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Why a result cannot be written: the path, the cause and the remedy.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The result is also an input.
    #[error("{}: is read as an input and would be lost; write the result elsewhere", .0.display())]
    IsInput(PathBuf),
    /// The system refused. The cause is no source: a closed pipe that the user named is an error.
    #[error("{}: {}{}", .place.display(), message(.cause), remedy(.cause.kind()))]
    Refused {
        /// The result.
        place: PathBuf,
        /// What the system says.
        cause: io::Error,
    },
}

impl WriteError {
    /// The error of a writer at a path.
    pub fn new(place: &Path, cause: impl Into<io::Error>) -> Self {
        Self::Refused { place: place.to_owned(), cause: system_error(cause.into()) }
    }
}

/// A result file that is being written.
pub struct AtomicFile {
    place: PathBuf,
    destination: BufWriter<Destination>,
}

enum Destination {
    /// A temporary file in the folder of the result.
    Scratch(NamedTempFile),
    /// A device or a pipe, which is written directly.
    Direct(File),
}

impl AtomicFile {
    /// Opens the result `place`, which must not be one of the `inputs`.
    ///
    /// # Errors
    /// [`WriteError`]
    pub fn new(place: &Path, inputs: &[&Path]) -> Result<Self, WriteError> {
        // A link stays a link: its target is replaced.
        let target = place.canonicalize().unwrap_or_else(|_| place.to_owned());
        if inputs.iter().any(|input| input.canonicalize().is_ok_and(|input| input == target)) {
            return Err(WriteError::IsInput(place.to_owned()));
        }
        let destination = open(&target).map_err(|error| WriteError::new(place, error))?;
        Ok(Self { place: target, destination: BufWriter::new(destination) })
    }

    /// Writes a text.
    ///
    /// # Errors
    /// [`WriteError`]
    pub fn put(&mut self, text: &str) -> Result<(), WriteError> {
        self.write_all(text.as_bytes()).map_err(|error| WriteError::new(&self.place, error))
    }

    /// Replaces the result files once all new ones are complete and on the disk.
    ///
    /// # Errors
    /// [`WriteError`]
    pub fn commit(results: impl IntoIterator<Item = Self>) -> Result<(), WriteError> {
        let mut complete = Vec::new();
        for Self { place, destination } in results {
            let flushed = destination.into_inner();
            let destination = flushed.map_err(|error| WriteError::new(&place, error.into_error()))?;
            if let Destination::Scratch(scratch) = &destination {
                // Some file systems report only here that they are full.
                scratch.as_file().sync_all().map_err(|error| WriteError::new(&place, error))?;
            }
            complete.push((place, destination));
        }
        for (place, destination) in complete {
            if let Destination::Scratch(scratch) = destination {
                scratch.persist(&place).map_err(|error| WriteError::new(&place, error.error))?;
            }
        }
        Ok(())
    }
}

/// Makes a folder for results, with those that it lies in.
///
/// # Errors
/// [`WriteError`]
pub fn make_folder(folder: &Path) -> Result<(), WriteError> {
    std::fs::create_dir_all(folder).map_err(|error| WriteError::new(folder, error))
}

/// Writes all of these names and texts into a folder, which is made if it does not exist, or none; no file may
/// be one of `inputs`.
///
/// # Errors
/// [`WriteError`]
pub fn write_texts<N: AsRef<Path>, T: AsRef<str>>(
    folder: &Path,
    inputs: &[&Path],
    texts: impl IntoIterator<Item = (N, T)>,
) -> Result<(), WriteError> {
    make_folder(folder)?;
    let write = |(name, text): (N, T)| {
        let mut file = AtomicFile::new(&folder.join(name), inputs)?;
        file.put(text.as_ref())?;
        Ok(file)
    };
    let files: Vec<AtomicFile> = texts.into_iter().map(write).collect::<Result<_, WriteError>>()?;
    AtomicFile::commit(files)
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.destination.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.destination.flush()
    }
}

impl Write for Destination {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            // Directly to the file: the error of `NamedTempFile` hides that of the system.
            Self::Scratch(scratch) => scratch.as_file_mut().write(bytes),
            Self::Direct(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Scratch(scratch) => scratch.as_file_mut().flush(),
            Self::Direct(file) => file.flush(),
        }
    }
}

fn open(target: &Path) -> io::Result<Destination> {
    match target.metadata() {
        Ok(there) if there.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(there) if !there.is_file() => {
            return File::options().write(true).open(target).map(Destination::Direct);
        }
        // Replacing the file would ignore its permissions.
        Ok(there) if there.permissions().readonly() => return Err(ErrorKind::PermissionDenied.into()),
        _ => {}
    }
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".nearwall-").suffix(".part");
    // Permissions of any new file; the umask of the user applies.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder.tempfile_in(folder).map(Destination::Scratch)
}

/// The error of the system itself, where the CSV writer has wrapped it.
fn system_error(error: io::Error) -> io::Error {
    if error.get_ref().is_none_or(|inner| !inner.is::<csv::Error>()) {
        return error;
    }
    match error.downcast::<csv::Error>().map(csv::Error::into_kind) {
        Ok(csv::ErrorKind::Io(error)) | Err(error) => error,
        Ok(other) => io::Error::other(format!("{other:?}")),
    }
}

fn remedy(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "; make room or write elsewhere (nothing there was changed)"
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; allow writing there or write elsewhere"
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory => "; make the folder first or write elsewhere",
        ErrorKind::IsADirectory => "; name a file in it",
        _ => "",
    }
}

/// The message of the system, if any, without the path of the temporary file that [`tempfile`] adds.
fn message(error: &io::Error) -> String {
    error
        .raw_os_error()
        .map_or_else(|| error.kind().to_string(), |code| io::Error::from_raw_os_error(code).to_string())
}
