//! The recorded impacts of each parcel in their order, from the `impacts.csv` of a finished case (key `record` of
//! nearWallInteraction), with what the tables state about the whole run.
//!
//! A wall law can be judged by replaying them: as long as it decides each impact as recorded, the
//! parcel's next impact is the recorded one.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{entries, file_name, tables, time_folders};
use crate::dataset::{DatasetError, ImpactReader, ImpactRow, PARCEL_COLUMNS};
use crate::results::RunResults;
use nearwall::impact::{ExtraInput, Impact};

/// The name of a record.
const RECORD: &str = "impacts.csv";

/// Folders below which each cloud has its own, seen from the case and from `postProcessing`.
const RECORD_FOLDERS: [&str; 2] = ["postProcessing/nearWallInteraction", "nearWallInteraction"];

/// Why the histories of a case cannot be read or replayed.
#[derive(Debug, thiserror::Error)]
pub enum HistoryError {
    /// There is no such folder.
    #[error("{}: there is no such folder; give the folder of a finished OpenFOAM case", .0.display())]
    NoFolder(PathBuf),
    /// No cloud, or not this one, has a record.
    #[error(
        "{}: no {RECORD}{}; add `record {{ }}` to nearWallInteractionCoeffs and run the case again",
        .folder.display(), of_cloud(.cloud.as_deref(), .found)
    )]
    NoRecord {
        /// The folder.
        folder: PathBuf,
        /// The cloud that the user names.
        cloud: Option<String>,
        /// The clouds with a record.
        found: Vec<String>,
    },
    /// Several clouds have a record and none is named.
    #[error("{}: several clouds have a record: {}; name one of them", .folder.display(), .clouds.join(", "))]
    SeveralClouds {
        /// The folder.
        folder: PathBuf,
        /// The clouds.
        clouds: Vec<String>,
    },
    /// The file cannot be read as impacts.
    #[error(transparent)]
    Unreadable(#[from] DatasetError),
    /// The parcels have no identity.
    #[error(
        "{}:{line}: the record has no column {column}, by which parcels are known again; an older nearWallInteraction \
         wrote it: build openfoam/ of this version and run the case again",
        .file.display()
    )]
    NoIdentity {
        /// The file.
        file: PathBuf,
        /// Line of the header, counted from 1.
        line: u64,
        /// The missing column.
        column: &'static str,
    },
    /// A line is damaged.
    #[error("{}:{line}: {reason}; run the case again, or remove all rows of this parcel", .file.display())]
    ImpactRow {
        /// The file.
        file: PathBuf,
        /// The line, counted from 1.
        line: u64,
        /// The reason.
        reason: String,
    },
    /// Two parcels have the same identity.
    #[error(
        "{}:{line}: parcel {} hits a wall after its capture, so two parcels have this identity; run the case again \
            from its start",
        .file.display(), .parcel.text()
    )]
    SharedIdentity {
        /// The file.
        file: PathBuf,
        /// Line of the later impact, counted from 1.
        line: u64,
        /// The identity.
        parcel: ParcelId,
    },
    /// The record holds some of the parcels only.
    #[error(
        "{}: the record holds 1 in {one_in} of the parcels; set maxRows in `record` to {counted} or more and run the \
            case again",
        .file.display()
    )]
    Sampled {
        /// The file.
        file: PathBuf,
        /// The record holds one parcel of so many.
        one_in: u64,
        /// Impacts of the run, or of the record where the tables are absent.
        counted: u64,
    },
    /// The record and the tables differ.
    #[error(
        "{}: the record holds {recorded} impacts, the tables count {counted} on the same patches; a replay needs a \
            record of all of a transient run: read the newest record, keep `record` on from the start, and end at a \
            write time",
        .file.display()
    )]
    Differs {
        /// The file.
        file: PathBuf,
        /// Impacts in the record.
        recorded: u64,
        /// Impacts in the tables that a model decided on the patches of the record.
        counted: u64,
    },
    /// The tables are absent.
    #[error(
        "{}: the tables of the run are not beside the record, so the injected mass is unknown and rows may be missing; \
         give the folder of the case",
        .0.display()
    )]
    NoTables(PathBuf),
}

fn of_cloud(cloud: Option<&str>, found: &[String]) -> String {
    match (cloud, found) {
        (None, _) => String::new(),
        (Some(cloud), []) => format!(" of cloud {cloud}"),
        (Some(cloud), found) => format!(" of cloud {cloud} (there is one of {})", found.join(", ")),
    }
}

/// Identity of a parcel, constant over ranks and restarts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParcelId {
    /// The rank that made the parcel, `origProcId`.
    pub rank: i64,
    /// Its number there, `origId`.
    pub number: i64,
}

impl ParcelId {
    fn text(self) -> String {
        format!("{}/{}", self.rank, self.number)
    }
}

/// What the run's own model decided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Decision {
    /// The wall captured the parcel.
    Captured,
    /// The parcel rebounded.
    Rebound {
        /// Normal restitution [1].
        e_n: f64,
        /// Tangential restitution [1].
        e_t: f64,
    },
}

/// One impact of a parcel.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordedImpact {
    /// Line in the file, counted from 1.
    pub line: u64,
    /// End of the time step [s].
    pub time: f64,
    /// Time that the parcel has moved since its injection [s].
    pub age: f64,
    /// Position [m].
    pub position: [f64; 3],
    /// The patch.
    pub patch: Arc<str>,
    /// The wall of the model.
    pub wall: Arc<str>,
    /// The injector.
    pub injector: Arc<str>,
    /// The inputs of the model, with those that it declares.
    pub impact: Impact,
    /// Mass of all particles of the parcel [kg].
    pub mass: f64,
    /// Number of particles of the parcel.
    pub particles: f64,
    /// What the run's model decided.
    pub decision: Decision,
}

/// The impacts of one parcel.
#[derive(Debug, Clone, PartialEq)]
pub struct ParcelHistory {
    /// The parcel.
    pub id: ParcelId,
    /// Its impacts in their order, at least one.
    pub impacts: Vec<RecordedImpact>,
}

/// The impacts of all recorded parcels.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactHistory {
    /// The record.
    pub file: PathBuf,
    /// Name of the cloud; empty for a record that is not in the folder of its case.
    pub cloud: String,
    /// The parcels with an impact, in the order of their identity.
    pub parcels: Vec<ParcelHistory>,
    /// Mass that the run injected [kg], where its tables are.
    pub injected_mass: Option<f64>,
    /// Number of parcels that the run injected, where its tables are.
    pub injected_parcels: Option<u64>,
    /// The record holds one parcel of so many; 1 for all.
    pub one_in: u64,
    /// Impacts in the tables that a model decided on the patches of the record.
    pub counted: Option<u64>,
    /// Patches without a recorded impact, with the rebounds and captures that the tables count there: constant
    /// coefficients decide, or the key `patches` of the record omits them.
    pub unrecorded: Vec<(String, u64)>,
    /// Impacts that the model refused: the parcel rebounded without loss and the record omits them.
    pub unusable: u64,
}

impl ImpactHistory {
    /// Number of recorded impacts.
    pub fn impacts(&self) -> u64 {
        self.parcels.iter().map(|parcel| parcel.impacts.len() as u64).sum()
    }

    /// Checks that the record holds every impact of the run, restarts included.
    ///
    /// # Errors
    /// [`HistoryError::Sampled`], [`HistoryError::NoTables`] or [`HistoryError::Differs`].
    pub fn check_complete(&self) -> Result<(), HistoryError> {
        let (file, recorded) = (self.file.clone(), self.impacts());
        let counted = self.counted.unwrap_or_else(|| recorded.saturating_mul(self.one_in));
        if self.one_in > 1 {
            return Err(HistoryError::Sampled { file, one_in: self.one_in, counted });
        }
        if self.counted.is_none() || self.injected_mass.is_none() {
            return Err(HistoryError::NoTables(file));
        }
        if recorded != counted {
            return Err(HistoryError::Differs { file, recorded, counted });
        }
        Ok(())
    }
}

/// Reads the newest record of a case. `place` is the case, its `postProcessing`, a folder below it, or a record itself;
/// `cloud` is needed where several clouds have a record. `extra_inputs` are those that the model declares.
///
/// # Errors
/// [`HistoryError`] for a place without a record, and for a record that is damaged or has no identities.
/// [`ImpactHistory::check_complete`] refuses a record that holds a part of the impacts.
pub fn read(
    place: &Path,
    cloud: Option<&str>,
    extra_inputs: &[ExtraInput],
) -> Result<ImpactHistory, HistoryError> {
    let file = find(place, cloud)?;
    let shown = file.display().to_string();
    let unreadable =
        |error: std::io::Error| DatasetError::Unreadable { file: shown.clone(), reason: error.to_string() };
    let source = BufReader::new(File::open(&file).map_err(unreadable)?);
    let (one_in, header_line) = preface(source).map_err(unreadable)?;
    let source = BufReader::new(File::open(&file).map_err(unreadable)?);
    let mut reader = ImpactReader::new(&shown, source)?.with_extra_inputs(extra_inputs);
    let columns = RecordColumns::of(&reader, &file, header_line)?;
    let mut names = Names::default();
    let mut parcels: BTreeMap<ParcelId, Vec<RecordedImpact>> = BTreeMap::new();
    let mut row = ImpactRow::default();
    while let Some(next) = reader.next_into(&mut row)? {
        let next = next.map_err(|bad| (bad.line, bad.reason));
        let read = next.and_then(|()| columns.read(&row, &mut names).map_err(|reason| (row.line, reason)));
        let (id, impact) =
            read.map_err(|(line, reason)| HistoryError::ImpactRow { file: file.clone(), line, reason })?;
        parcels.entry(id).or_default().push(impact);
    }
    let histories = histories(parcels, &file)?;
    let mut history = ImpactHistory {
        file,
        cloud: String::new(),
        parcels: histories,
        injected_mass: None,
        injected_parcels: None,
        one_in,
        counted: None,
        unrecorded: Vec::new(),
        unusable: 0,
    };
    add_tables(&mut history);
    Ok(history)
}

/// The impacts of each parcel in the order of time.
fn histories(
    parcels: BTreeMap<ParcelId, Vec<RecordedImpact>>,
    file: &Path,
) -> Result<Vec<ParcelHistory>, HistoryError> {
    let history = |(id, mut impacts): (ParcelId, Vec<RecordedImpact>)| {
        // Stable: the record has impacts at one instant in their order.
        impacts.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.age.total_cmp(&b.age)));
        let captured = impacts.iter().position(|impact| impact.decision == Decision::Captured);
        match captured.and_then(|index| impacts.get(index + 1)) {
            Some(later) => {
                Err(HistoryError::SharedIdentity { file: file.to_owned(), line: later.line, parcel: id })
            }
            None => Ok(ParcelHistory { id, impacts }),
        }
    };
    parcels.into_iter().map(history).collect()
}

/// The fraction that the first line states, and the line of the header.
fn preface(source: impl BufRead) -> std::io::Result<(u64, u64)> {
    let (mut one_in, mut header) = (1, 1);
    for line in source.split(b'\n') {
        let line = line?;
        let Some(comment) = line.strip_prefix(b"#") else { break };
        header += 1;
        let comment = String::from_utf8_lossy(comment);
        let stated = comment.split_once("recorded impacts: 1 in ").map(|(_, rest)| rest);
        let number = stated.and_then(|rest| rest.split_whitespace().next()?.parse::<f64>().ok());
        one_in = number.map_or(one_in, |number| number as u64);
    }
    Ok((one_in, header))
}

/// The newest `impacts.csv` that a place stands for: the file itself, or a case, a cloud's tables
/// or a folder around them.
///
/// # Errors
/// [`HistoryError`] for a place without a record or with those of several clouds.
pub fn find(place: &Path, cloud: Option<&str>) -> Result<PathBuf, HistoryError> {
    let no_record =
        |found| HistoryError::NoRecord { folder: place.to_owned(), cloud: cloud.map(str::to_owned), found };
    // Ends as `<cloud>/<start time>/impacts.csv` where the folders around it are known.
    let whole = std::fs::canonicalize(place).map_err(|_| HistoryError::NoFolder(place.to_owned()))?;
    if whole.is_file() {
        return Ok(place.to_owned());
    }
    if place.join(RECORD).is_file() {
        return Ok(place.join(RECORD));
    }
    if let Some(file) = newest(place) {
        return match cloud {
            Some(cloud) if cloud != file_name(&whole) => Err(no_record(vec![file_name(&whole).to_owned()])),
            _ => Ok(file),
        };
    }
    let folders = RECORD_FOLDERS.map(|below| place.join(below)).into_iter().find(|folder| folder.is_dir());
    let clouds = entries(folders.as_deref().unwrap_or(place), Path::is_dir).into_iter();
    let mut records: Vec<(String, PathBuf)> =
        clouds.filter_map(|folder| Some((file_name(&folder).to_owned(), newest(&folder)?))).collect();
    let names: Vec<String> = records.iter().map(|(name, _)| name.clone()).collect();
    if let Some(cloud) = cloud {
        records.retain(|(name, _)| name == cloud);
    }
    match records.pop() {
        Some((_, file)) if records.is_empty() => Ok(file),
        Some(_) => Err(HistoryError::SeveralClouds { folder: place.to_owned(), clouds: names }),
        None => Err(no_record(names)),
    }
}

/// The record of the latest start of the solver in a cloud's folder.
fn newest(cloud: &Path) -> Option<PathBuf> {
    let files = time_folders(cloud).into_iter().map(|(_, folder)| folder.join(RECORD));
    files.rev().find(|file| file.is_file())
}

/// The columns of a record beside the inputs.
struct RecordColumns {
    identity: [usize; PARCEL_COLUMNS.len()],
    time: usize,
    position: [usize; 3],
    patch: usize,
    wall: usize,
    injector: usize,
    mass: usize,
    outcome: usize,
    restitution: [usize; 2],
}

impl RecordColumns {
    fn of<R: std::io::Read>(
        reader: &ImpactReader<R>,
        file: &Path,
        header_line: u64,
    ) -> Result<Self, HistoryError> {
        let identity = |column: &'static str| {
            let missing = || HistoryError::NoIdentity { file: file.to_owned(), line: header_line, column };
            reader.column(column).ok_or_else(missing)
        };
        let other = |name: &str| {
            let missing = || DatasetError::Header {
                file: file.display().to_string(),
                line: header_line,
                problem: format!(
                    "there is no column {name}; give an {RECORD} as nearWallInteraction wrote it"
                ),
            };
            reader.column(name).ok_or_else(missing)
        };
        let [rank, number, age, particles] = PARCEL_COLUMNS;
        Ok(Self {
            identity: [identity(rank)?, identity(number)?, identity(age)?, identity(particles)?],
            time: other("time")?,
            position: [other("x")?, other("y")?, other("z")?],
            patch: other("patch")?,
            wall: other("wall")?,
            injector: other("injector")?,
            mass: other("mass")?,
            outcome: other("outcome")?,
            restitution: [other("e_n")?, other("e_t")?],
        })
    }

    /// Reads a row.
    ///
    /// # Errors
    /// The reason why it is damaged.
    fn read(&self, row: &ImpactRow, names: &mut Names) -> Result<(ParcelId, RecordedImpact), String> {
        let cell = |index: usize| row.cells.get(index).unwrap_or("");
        let number = |index: usize, name: &str| {
            let value = cell(index).parse().ok().filter(|value: &f64| value.is_finite());
            value.ok_or_else(|| format!("{name} `{}` is not a number", cell(index)))
        };
        let label = |index: usize, name: &str| {
            cell(index).parse().map_err(|_| format!("{name} `{}` is not a whole number", cell(index)))
        };
        let [rank, own, age, particles] = self.identity;
        let [x, y, z] = self.position;
        let id = ParcelId { rank: label(rank, PARCEL_COLUMNS[0])?, number: label(own, PARCEL_COLUMNS[1])? };
        let decision = match cell(self.outcome) {
            "stick" => Decision::Captured,
            "rebound" => Decision::Rebound {
                e_n: number(self.restitution[0], "e_n")?,
                e_t: number(self.restitution[1], "e_t")?,
            },
            other => return Err(format!("outcome `{other}` is unknown; a record has rebound or stick")),
        };
        let impact = RecordedImpact {
            line: row.line,
            time: number(self.time, "time")?,
            age: number(age, PARCEL_COLUMNS[2])?,
            position: [number(x, "x")?, number(y, "y")?, number(z, "z")?],
            patch: names.shared(cell(self.patch)),
            wall: names.shared(cell(self.wall)),
            injector: names.shared(cell(self.injector)),
            impact: row.impact,
            mass: number(self.mass, "mass")?,
            particles: number(particles, PARCEL_COLUMNS[3])?,
            decision,
        };
        Ok((id, impact))
    }
}

/// The few names of patches, walls and injectors, each kept once.
#[derive(Default)]
struct Names(BTreeMap<String, Arc<str>>);

impl Names {
    fn shared(&mut self, name: &str) -> Arc<str> {
        if let Some(known) = self.0.get(name) {
            return known.clone();
        }
        let new: Arc<str> = name.into();
        self.0.insert(name.to_owned(), new.clone());
        new
    }
}

/// Adds what the tables of the cloud state, where they are.
fn add_tables(history: &mut ImpactHistory) {
    let whole = std::fs::canonicalize(&history.file).unwrap_or_else(|_| history.file.clone());
    let mut folders = whole.ancestors().skip(1);
    let (Some(start), Some(cloud)) = (folders.next(), folders.next()) else { return };
    if file_name(start).parse::<f64>().is_err() {
        return;
    }
    let mut run = RunResults::default();
    tables::read_into(&mut run, cloud);
    let rows = run.walls.iter().filter_map(|wall| Some((&wall.wall, &wall.rows.last()?.1)));
    let decided: Vec<(&String, u64)> =
        rows.map(|(wall, totals)| (wall, totals.e_n.count + totals.captured.count)).collect();
    if decided.is_empty() {
        return;
    }
    let all = history.parcels.iter().flat_map(|parcel| &parcel.impacts);
    let patches: std::collections::BTreeSet<&str> = all.map(|impact| &*impact.patch).collect();
    let (own, others): (Vec<_>, Vec<_>) =
        decided.into_iter().partition(|(wall, _)| patches.contains(wall.as_str()));
    history.counted = Some(own.iter().map(|(_, count)| count).sum());
    let others = others.into_iter().filter(|(_, count)| *count > 0);
    history.unrecorded = others.map(|(wall, count)| (wall.clone(), count)).collect();
    history.cloud = file_name(cloud).to_owned();
    history.injected_mass = run.injected.last().map(|[_, mass]| *mass);
    history.unusable = tables::unusable(cloud);
    history.injected_parcels = tables::injected_parcels(cloud);
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "time,x,y,z,origProcId,origId,parcel_age,n_particles,v_n,v_t,d,patch,wall,injector,mass,regime,outcome,e_n,e_t,humidity";

    /// The lines of a record: of parcel 0/7 three impacts, the last two in one step, of parcel 1/7 one.
    const ROWS: [&str; 4] = [
        "0.002,0,0,0,0,7,0.001,50,2,1,1e-4,floor,default,jet,1e-6,NSP-NSW,rebound,0.5,0.75,0.3",
        "0.004,0,0,0.1,0,7,0.0038,50,0.9,0.7,1e-4,lid,hot,jet,1e-6,SP-NSW,stick,,,",
        "0.004,0.1,0,0,0,7,0.0031,50,1,0.75,1e-4,floor,default,jet,1e-6,NSP-NSW,rebound,0.4,-0.1,0.3",
        "0.004,0.1,0,0,1,7,0.0031,25,1,0.75,1e-4,floor,default,jet,5e-7,NSP-NSW,stick,,,0.3",
    ];

    /// A case with a record in the folder of each start.
    struct Case(tempfile::TempDir);

    impl Case {
        fn new() -> Self {
            Self(tempfile::tempdir().unwrap())
        }

        fn path(&self) -> &Path {
            self.0.path()
        }

        fn with(self, cloud: &str, start: &str, name: &str, text: &str) -> Self {
            let folder = self.path().join(RECORD_FOLDERS[0]).join(cloud).join(start);
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(folder.join(name), text).unwrap();
            self
        }

        fn recorded(self, start: &str, share: &str, rows: &[&str]) -> Self {
            self.with("cloud", start, RECORD, &record(share, HEADER, rows))
        }

        fn tables(self) -> Self {
            let hits = |n: u32, r: u32| {
                format!("# time_s hits rebounds sticks e_n_sum unusable\n0.004 {n} {r} {} 1 2\n", n - r)
            };
            let balance = "# time_s injected_kg injected_parcels residual\n0.002 1e-6 1 0\n0.004 4e-6 8 0\n";
            self.with("cloud", "0", "floor.dat", &hits(3, 2))
                .with("cloud", "0", "lid.dat", &hits(1, 0))
                .with("cloud", "0", "sides.dat", &hits(6, 5))
                .with("cloud", "0", "balance.dat", balance)
        }

        fn read(&self) -> Result<ImpactHistory, HistoryError> {
            read(self.path(), None, &[])
        }

        fn fault(&self) -> String {
            self.read().unwrap_err().to_string()
        }
    }

    fn record(share: &str, header: &str, rows: &[&str]) -> String {
        let first = format!("# nearWallInteraction, recorded impacts: {share} since the start of the case");
        format!("{first}\n{header}\n{}\n", rows.join("\n"))
    }

    #[test]
    fn impacts_are_in_the_order_of_each_parcels_path() {
        let case = Case::new().recorded("0", "all", &ROWS).tables();
        let humidity = [ExtraInput::number("humidity", f64::NAN)];
        let history = read(case.path(), None, &humidity).unwrap();
        history.check_complete().unwrap();
        assert_eq!((history.cloud.as_str(), history.one_in, history.impacts()), ("cloud", 1, 4));
        assert_eq!((history.injected_mass, history.injected_parcels), (Some(4e-6), Some(8)));
        assert_eq!(history.unusable, 6);
        assert_eq!((history.counted, history.unrecorded), (Some(4), vec![("sides".to_owned(), 6)]));
        let [first, second] = &history.parcels[..] else { unreachable!() };
        assert_eq!((first.id, second.id.rank), (ParcelId { rank: 0, number: 7 }, 1));
        let ages: Vec<f64> = first.impacts.iter().map(|impact| impact.age).collect();
        assert_eq!(ages, [0.001, 0.0031, 0.0038]);
        let last = &first.impacts[2];
        assert_eq!((last.line, &*last.patch, &*last.wall, &*last.injector), (4, "lid", "hot", "jet"));
        assert_eq!((last.position, last.mass, last.particles), ([0.0, 0.0, 0.1], 1e-6, 50.0));
        assert_eq!((last.impact.normal_speed, last.impact.extra[0].is_nan()), (0.9, true));
        assert_eq!(last.decision, Decision::Captured);
        assert_eq!(first.impacts[1].decision, Decision::Rebound { e_n: 0.4, e_t: -0.1 });
        assert_eq!(first.impacts[1].impact.extra[0], 0.3);
    }

    #[test]
    fn a_record_is_found_from_every_folder_around_it() {
        let case = Case::new().recorded("0", "all", &ROWS[..1]).recorded("0.1", "all", &ROWS).tables();
        let tables = case.path().join(RECORD_FOLDERS[0]);
        for place in
            [case.path().into(), case.path().join("postProcessing"), tables.clone(), tables.join("cloud")]
        {
            let history = read(&place, Some("cloud"), &[]).unwrap();
            assert_eq!((history.impacts(), history.cloud.as_str()), (4, "cloud"), "{}", place.display());
        }
        let old = tables.join("cloud/0");
        for place in [old.join(RECORD), old] {
            let history = read(&place, None, &[]).unwrap();
            assert_eq!((history.impacts(), history.counted), (1, Some(3)));
            let fault = history.check_complete().unwrap_err().to_string();
            assert!(fault.contains("holds 1 impacts, the tables count 3"), "{fault}");
        }
        let lone = case.path().join("elsewhere");
        std::fs::create_dir(&lone).unwrap();
        std::fs::copy(tables.join("cloud/0.1").join(RECORD), lone.join(RECORD)).unwrap();
        let history = read(&lone, None, &[]).unwrap();
        assert_eq!((history.impacts(), history.injected_mass, history.cloud.as_str()), (4, None, ""));
        assert!(history.check_complete().unwrap_err().to_string().contains("give the folder of the case"));
    }

    #[test]
    fn a_cloud_is_named_where_several_have_a_record() {
        let case = Case::new().recorded("0", "all", &ROWS);
        let fault = read(case.path(), Some("coal"), &[]).unwrap_err().to_string();
        assert!(
            fault.contains("no impacts.csv of cloud coal (there is one of cloud); add `record { }`"),
            "{fault}"
        );
        let case = case.with("coal", "0", RECORD, &record("all", HEADER, &ROWS[..1]));
        assert!(
            case.fault().contains("several clouds have a record: cloud, coal; name one"),
            "{}",
            case.fault()
        );
        assert_eq!(read(case.path(), Some("coal"), &[]).unwrap().impacts(), 1);
        let empty = Case::new();
        assert!(empty.fault().contains("no impacts.csv; add `record { }`"), "{}", empty.fault());
        let gone = read(Path::new("/no/such/case"), None, &[]).unwrap_err().to_string();
        assert!(gone.starts_with("/no/such/case: there is no such folder"), "{gone}");
    }

    #[test]
    fn a_sample_is_read_and_refused_as_a_whole() {
        let history = Case::new().recorded("0", "1 in 8", &ROWS).tables().read().unwrap();
        assert_eq!((history.one_in, history.parcels.len()), (8, 2));
        let fault = history.check_complete().unwrap_err().to_string();
        assert!(fault.contains("1 in 8 of the parcels; set maxRows in `record` to 4 or more"), "{fault}");
    }

    #[test]
    fn damage_is_named_with_its_line_and_remedy() {
        let old = HEADER.replace("origProcId,origId,parcel_age,n_particles,", "");
        let case = Case::new().with("cloud", "0", RECORD, &record("all", &old, &[]));
        let fault = case.fault();
        assert!(fault.contains("impacts.csv:2: the record has no column origProcId"), "{fault}");
        assert!(fault.contains("run the case again"), "{fault}");
        let with = |row: &str| Case::new().recorded("0", "all", &[ROWS[0], row]).fault();
        let place = "impacts.csv:4: ";
        assert!(with("0.004,0,0").contains(&format!("{place}the row has 3 cells")));
        let fault = with(&ROWS[2].replace(",0,7,", ",0,7.5,"));
        assert!(fault.contains(&format!("{place}origId `7.5` is not a whole number")), "{fault}");
        let fault = with(&ROWS[2].replace("rebound", "bounce"));
        assert!(fault.contains(&format!("{place}outcome `bounce` is unknown")), "{fault}");
        let fault = with(&ROWS[2].replace("0.4,-0.1", ",-0.1"));
        assert!(fault.contains(&format!("{place}e_n `` is not a number")), "{fault}");
        let later = ROWS[0].replace("0.002,", "0.006,");
        let fault = Case::new().recorded("0", "all", &[ROWS[1], &later]).fault();
        assert!(fault.contains(&format!("{place}parcel 0/7 hits a wall after its capture")), "{fault}");
        let case =
            Case::new().with("cloud", "0", RECORD, &record("all", &HEADER.replace("mass,", "weight,"), &[]));
        assert!(case.fault().contains("impacts.csv:2: there is no column mass"), "{}", case.fault());
    }
}
