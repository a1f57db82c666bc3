//! The system's C and C++ compilers, strict, and the shared library they link to.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use tempfile::TempDir;

/// Where cargo puts the shared library that belongs to the running test.
pub fn library_path() -> PathBuf {
    let exe = std::env::current_exe().unwrap();
    exe.parent().unwrap().join("libnearwall.so")
}

/// A language and its standard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    C(&'static str),
    Cpp(&'static str),
}

/// Every warning that matters is an error.
const STRICT: [&str; 6] = ["-Wall", "-Wextra", "-pedantic", "-Wshadow", "-Wconversion", "-Werror"];

impl Language {
    /// The compiler with its strict options, and the header's folder.
    fn compiler(self) -> Command {
        let (variable, usual, standard) = match self {
            Self::C(standard) => ("CC", "cc", standard),
            Self::Cpp(standard) => ("CXX", "c++", standard),
        };
        let mut command = Command::new(std::env::var_os(variable).unwrap_or_else(|| usual.into()));
        command.arg(format!("-std={standard}")).args(STRICT);
        if let Self::Cpp(_) = self {
            command.args(["-Wold-style-cast", "-Wnon-virtual-dtor"]);
        }
        command.arg("-I").arg(root().join("cpp_shim"));
        command
    }

    fn ending(self) -> &'static str {
        match self {
            Self::C(_) => "c",
            Self::Cpp(_) => "cpp",
        }
    }
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs a command that has to succeed; gives what it printed.
pub fn run(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|error| panic!("{command:?}: {error}"));
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{command:?}: {}\n{out}\n{err}", output.status);
    out.into_owned()
}

/// Compiles a text on its own, without linking.
pub fn compiles(language: Language, text: &str) {
    let folder = TempDir::new().unwrap();
    let source = folder.path().join("alone").with_extension(language.ending());
    std::fs::write(&source, text).unwrap();
    run(language.compiler().arg("-fsyntax-only").arg(source));
}

/// How the library was built.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Build {
    /// With this test, unoptimised unless the test is.
    Tested,
    /// As it is shipped to a solver: optimised.
    Shipped,
}

/// Words that `tests/hard` adds: options of the compiler, and what runs the program.
fn words(variable: &str) -> Vec<String> {
    let text = std::env::var(variable).unwrap_or_default();
    text.split_whitespace().map(str::to_owned).collect()
}

/// The shared library of a build; `tests/hard` may put another in its place.
pub fn shared_library(build: Build) -> PathBuf {
    if let Some(other) = std::env::var_os("NEARWALL_LIBRARY") {
        return other.into();
    }
    match build {
        Build::Tested => library_path(),
        Build::Shipped => shipped_library().to_owned(),
    }
}

/// The library of the build that makes the command, too; openfoam/Allwmake and bindings/install take the same.
fn shipped_library() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| {
        let mut cargo = Command::new(env!("CARGO"));
        run(cargo.args(["build", "--release", "--locked", "--offline", "--quiet"]).current_dir(root()));
        let target =
            std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
        target.join("release/libnearwall.so")
    })
}

/// The next version of the library, from a copy of the source with another version, ABI number and soname.
pub fn next_version() -> PathBuf {
    let folder = root().join("target/next-version");
    copy(&root().join("src"), &folder.join("src"));
    let edited = |file: &str, pairs: &[(&str, &str)]| {
        let mut text = std::fs::read_to_string(root().join(file)).unwrap();
        for (from, to) in pairs {
            assert!(text.contains(from), "{file} no longer has {from}");
            text = text.replace(from, to);
        }
        write_if_other(&folder.join(file), text.as_bytes());
    };
    let version = format!("version = \"{}\"\nedition", env!("CARGO_PKG_VERSION"));
    let manifest = std::fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let line = |start: &str| manifest.lines().find(|line| line.starts_with(start)).unwrap();
    let tests = &manifest[manifest.find("[[test]]").unwrap()..manifest.find("[dependencies]").unwrap()];
    let abi = nearwall::c_api::NW_ABI_VERSION;
    edited(
        "Cargo.toml",
        &[
            (&version, "version = \"99.0.0\"\nedition"),
            (line("members = "), "members = []"),
            (line("default-members = "), ""),
            (tests, ""),
        ],
    );
    edited("build.rs", &[(&format!("libnearwall.so.{abi}"), "libnearwall.so.99")]);
    edited("src/c_api/mod.rs", &[(&format!("NW_ABI_VERSION: u32 = {abi};"), "NW_ABI_VERSION: u32 = 99;")]);
    write_if_other(&folder.join("Cargo.lock"), &std::fs::read(root().join("Cargo.lock")).unwrap());
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--offline", "--quiet", "--config", "profile.dev.package.nearwall.opt-level=0"]);
    run(cargo.arg("--target-dir").arg(folder.join("target")).current_dir(&folder));
    folder.join("target/debug/libnearwall.so")
}

fn copy(from: &Path, to: &Path) {
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let place = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &place);
        } else if !place.ends_with("src/c_api/mod.rs") {
            write_if_other(&place, &std::fs::read(path).unwrap());
        }
    }
}

/// A file that stays as it is keeps its time, so that cargo builds nothing twice.
fn write_if_other(place: &Path, bytes: &[u8]) {
    if std::fs::read(place).is_ok_and(|there| there == bytes) {
        return;
    }
    std::fs::create_dir_all(place.parent().unwrap()).unwrap();
    std::fs::write(place, bytes).unwrap();
}

/// A program of `tests/c`, compiled, linked to the library and ready to run where it finds it by its soname.
pub struct Program {
    folder: TempDir,
}

impl Program {
    /// Compiles `tests/c/<source>` and links it to a build of the library.
    pub fn build(language: Language, source: &str, build: Build) -> Self {
        let folder = TempDir::new().unwrap();
        std::fs::copy(shared_library(build), folder.path().join("libnearwall.so.1")).unwrap();
        std::os::unix::fs::symlink("libnearwall.so.1", folder.path().join("libnearwall.so")).unwrap();
        let mut compiler = language.compiler();
        compiler.arg("-O2").args(words("NEARWALL_CFLAGS")).arg(root().join("tests/c").join(source));
        compiler.arg("-o").arg(folder.path().join("program")).arg("-L").arg(folder.path());
        run(compiler.args(["-Wl,-rpath,$ORIGIN", "-lnearwall", "-lm", "-ldl", "-lpthread"]));
        Self { folder }
    }

    /// Where the program and its library are; a place for its files.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Runs it; it has to succeed. Gives what it printed.
    pub fn run(&self, arguments: &[&Path]) -> String {
        let program = self.folder().join("program");
        let mut runner = words("NEARWALL_RUNNER").into_iter();
        let mut command = runner.next().map_or_else(|| Command::new(&program), Command::new);
        if command.get_program() != program {
            command.args(runner).arg(program);
        }
        run(command.args(arguments))
    }
}
