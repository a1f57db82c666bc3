//! Writes result files atomically: to a temporary file, which replaces the result when it is complete.
//!
//! A run that fails or a full disk leaves the previous file unchanged, and no reader sees half a result.

use std::fs::File;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// A result file that is being written.
pub struct AtomicFile {
    place: PathBuf,
    sink: BufWriter<Sink>,
}

enum Sink {
    /// A temporary file in the folder of the result.
    Scratch(NamedTempFile),
    /// A device or a pipe, which is written directly.
    Direct(File),
}

impl AtomicFile {
    /// Opens the result `place`, which must not be one of the `inputs`.
    ///
    /// # Errors
    /// A message with the path, the cause and the remedy.
    pub fn new(place: &Path, inputs: &[&Path]) -> Result<Self, String> {
        // A link stays a link: its target is replaced.
        let target = place.canonicalize().unwrap_or_else(|_| place.to_owned());
        if inputs.iter().any(|input| input.canonicalize().is_ok_and(|input| input == target)) {
            return Err(format!(
                "{}: is read as an input and would be lost; write the result elsewhere",
                place.display()
            ));
        }
        let sink = open(&target).map_err(|error| refused(place, &error))?;
        Ok(Self { place: target, sink: BufWriter::new(sink) })
    }

    /// Writes a text.
    ///
    /// # Errors
    /// A message with the path, the cause and the remedy.
    pub fn put(&mut self, text: &str) -> Result<(), String> {
        self.write_all(text.as_bytes()).map_err(|error| refused(&self.place, &error))
    }

    /// Replaces the result files once all new ones are complete and on the disk.
    ///
    /// # Errors
    /// A message with the path, the cause and the remedy.
    pub fn commit(results: Vec<Self>) -> Result<(), String> {
        let mut whole = Vec::new();
        for result in results {
            let Self { place, sink } = result;
            let sink = sink.into_inner().map_err(|error| refused(&place, error.error()))?;
            if let Sink::Scratch(scratch) = &sink {
                // Some file systems report only here that they are full.
                scratch.as_file().sync_all().map_err(|error| refused(&place, &error))?;
            }
            whole.push((place, sink));
        }
        for (place, sink) in whole {
            if let Sink::Scratch(scratch) = sink {
                scratch.persist(&place).map_err(|error| refused(&place, &error.error))?;
            }
        }
        Ok(())
    }
}

impl Write for AtomicFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.sink.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sink.flush()
    }
}

impl Write for Sink {
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

fn open(target: &Path) -> io::Result<Sink> {
    match target.metadata() {
        Ok(there) if there.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(there) if !there.is_file() => {
            return File::options().write(true).open(target).map(Sink::Direct);
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
    builder.tempfile_in(folder).map(Sink::Scratch)
}

/// The system error within an error of the CSV writer.
pub fn of_csv(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}

/// The message for an error at a path, with its remedy.
pub fn refused(place: &Path, error: &io::Error) -> String {
    let remedy = match error.kind() {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge => {
            "; make room or write elsewhere (nothing there was changed)"
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; allow writing there or write elsewhere"
        }
        ErrorKind::NotFound | ErrorKind::NotADirectory => "; make the folder first or write elsewhere",
        ErrorKind::IsADirectory => "; name a file in it",
        _ => "",
    };
    format!("{}: {}{remedy}", place.display(), reason(error))
}

/// The message of the system, if any, without the path of the temporary file that [`tempfile`] adds.
fn reason(error: &io::Error) -> String {
    error
        .raw_os_error()
        .map_or_else(|| error.kind().to_string(), |code| io::Error::from_raw_os_error(code).to_string())
}
