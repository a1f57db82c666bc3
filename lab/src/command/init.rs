//! `nearwall init`: a commented case of one field that runs.

use std::path::{Path, PathBuf};

use crate::atomic_file::write_texts;

use super::CommandResult;

/// Writes a commented case of your field that runs, and prints the next command
#[derive(clap::Args)]
#[command(
    after_help = "Example:\n  nearwall init superheater\n  nearwall simulate superheater/superheater.toml -o \
        superheater/results\n\n\
    Existing files are not overwritten."
)]
pub struct Arguments {
    /// The field
    #[arg(value_enum)]
    kind: Kind,
    /// The folder that gets the files; by default one with the name of the field
    #[arg(value_name = "DIR")]
    folder: Option<PathBuf>,
}

/// A field with a case of its own.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Kind {
    /// Char and slag in a swirling gasifier
    Gasifier,
    /// Ash on a cooled superheater tube
    Superheater,
    /// Tungsten dust in a tokamak
    Tokamak,
    /// Road dust on a turbine vane
    Turbine,
    /// Measured impacts of wax, to be explained
    Laboratory,
}

/// The case of a field: the files of a tutorial under the names that they get.
struct StartingCase {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
    /// What to do with them; `DIR` stands for their folder.
    next: &'static str,
}

macro_rules! tutorial {
    ($path:literal) => {
        include_str!(concat!("../../../tutorials/", $path))
    };
}

static GASIFIER: StartingCase = StartingCase {
    name: "gasifier",
    files: &[
        ("gasifier.toml", tutorial!("standalone/gasifier.toml")),
        ("gasifier.model.toml", tutorial!("standalone/gasifier.model.toml")),
    ],
    next: "nearwall simulate DIR/gasifier.toml -o DIR/results",
};
static SUPERHEATER: StartingCase = StartingCase {
    name: "superheater",
    files: &[
        ("superheater.toml", tutorial!("standalone/superheater.toml")),
        ("nearWall.toml", tutorial!("superheater/constant/nearWall.toml")),
    ],
    next: "nearwall simulate DIR/superheater.toml -o DIR/results",
};
static TOKAMAK: StartingCase = StartingCase {
    name: "tokamak",
    files: &[
        ("tungstenDust.toml", tutorial!("standalone/tungstenDust.toml")),
        ("tungstenDust.model.toml", tutorial!("standalone/tungstenDust.model.toml")),
    ],
    next: "nearwall simulate DIR/tungstenDust.toml -o DIR/results",
};
static TURBINE: StartingCase = StartingCase {
    name: "turbine",
    files: &[
        ("turbine.toml", tutorial!("standalone/turbine.toml")),
        ("turbine.model.toml", tutorial!("standalone/turbine.model.toml")),
    ],
    next: "nearwall simulate DIR/turbine.toml -o DIR/results",
};
static LABORATORY: StartingCase = StartingCase {
    name: "laboratory",
    files: &[
        ("measured.csv", tutorial!("waxImpactor/measured/troiano.csv")),
        ("base.toml", tutorial!("waxImpactor/measured/base.toml")),
    ],
    next: "nearwall diagnose DIR/measured.csv --model DIR/base.toml --out DIR/diagnosis",
};

/// Where the superheater's model lies beside its tutorial; `init` puts it beside the case.
const MODEL_OF_ANOTHER_TUTORIAL: &str = "../superheater/constant/";

impl Kind {
    fn case(self) -> &'static StartingCase {
        match self {
            Self::Gasifier => &GASIFIER,
            Self::Superheater => &SUPERHEATER,
            Self::Tokamak => &TOKAMAK,
            Self::Turbine => &TURBINE,
            Self::Laboratory => &LABORATORY,
        }
    }
}

pub fn run(arguments: &Arguments) -> CommandResult {
    let case = arguments.kind.case();
    let folder = arguments.folder.as_deref().unwrap_or(Path::new(case.name));
    let paths = || case.files.iter().map(|(name, _)| folder.join(name));
    if let Some(there) = paths().find(|path| path.exists()) {
        let problem = "exists and is not overwritten; name another folder, as in";
        let other = folder.with_extension("new");
        return Err(format!(
            "{}: {problem} `nearwall init {} {}`",
            there.display(),
            case.name,
            other.display()
        )
        .into());
    }
    let text = |text: &str| text.replace(MODEL_OF_ANOTHER_TUTORIAL, "");
    write_texts(folder, &[], case.files.iter().map(|(name, content)| (*name, text(content))))?;
    let written: String = paths().map(|path| format!("{}\n", path.display())).collect();
    let next = case.next.replace("DIR", &folder.display().to_string());
    super::print(&format!("{written}next: {next}\n"))
}
