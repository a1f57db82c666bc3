//! The page of finished OpenFOAM cases: from files as the solvers and our library write them, and in a real browser.

use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Output};

use crate::common::browser::{Seen, browse};
use nearwall_lab::report::openfoam_page;
use nearwall_lab::results::classes::{ClassQuantity, together};
use nearwall_lab::results::openfoam::{self, deposit};
use nearwall_lab::results::{Amount, History, WallModel, WallTotals};

const PATCHES: [&str; 2] = ["slagWall", "quenchWall"];

pub(crate) fn write(root: &Path, name: &str, text: &str) {
    let path = root.join(name);
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    std::fs::write(path, text).unwrap();
}

/// What every case has: control dictionary, mesh patches, coal properties with the named wall model.
fn skeleton(root: &Path, model: &str) {
    write(root, "system/controlDict", "application coalChemistryFoam;\n");
    let wall =
        |name: &str| format!("    {name}\n    {{\n        type wall;\n        inGroups 1(wall);\n    }}\n");
    let patches: String = PATCHES.iter().map(|name| wall(name)).collect();
    write(
        root,
        "constant/polyMesh/boundary",
        &format!("FoamFile\n{{\n}}\n3\n(\n{patches}    outlet\n    {{\n        type patch;\n    }}\n)\n"),
    );
    write(root, "constant/wallInteraction", &format!("// the wall\npatchInteractionModel {model};\n"));
    write(
        root,
        "constant/coalCloud1Properties",
        "singleMixtureFractionCoeffs { phases ( gas { CO 1; } liquid { H2O 1; } solid { C 0.84; ash 0.16; } ); \
         YGasTot0 0.4; YLiquidTot0 0; YSolidTot0 0.6; }\n",
    );
}

/// A table as nearWallInteraction writes it: `rows` of time, hits, hit mass, sticks, stick mass.
fn table(rows: &[[f64; 5]]) -> String {
    let mut text = "# time_s hits hit_particles hit_mass_kg rebounds rebound_mass_kg sticks stick_particles \
                    stick_mass_kg escapes escape_mass_kg unusable unusable_mass_kg impact_speed_sum_m_s"
        .to_owned();
    for regime in ["NSP-NSW", "NSP-SW", "SP-NSW", "SP-SW"] {
        write!(text, " sticks_{regime}").unwrap();
    }
    for regime in ["NSP-NSW", "NSP-SW", "SP-NSW", "SP-SW"] {
        write!(text, " stick_mass_{regime}_kg").unwrap();
    }
    for tenth in 0..10 {
        write!(text, " stick_mass_conversion_0.{tenth}_kg").unwrap();
    }
    text += " capture_by_particles capture_by_mass\n";
    for [time, hits, mass, sticks, stuck] in rows {
        writeln!(
            text,
            "{time} {hits} {hits} {mass} {} {} {sticks} {sticks} {stuck} 0 0 0 0 {} 0 {sticks} 0 0 0 {stuck} 0 0 \
             0 {stuck} 0 0 0 0 0 0 0 0 0 0",
            hits - sticks,
            mass - stuck,
            2.0 * hits
        )
        .unwrap();
    }
    text
}

/// Distributions as nearWallInteraction writes them: two injectors, of 100 parcels 60 stick, all of
/// one speed; the energy that leaves is 0.09 of what came. The numbers are `scale` times that.
fn distributions(time: f64, scale: f64) -> String {
    let mut text = "# time_s injector quantity low high hits particles particles_squared mass_kg sticks stick_particles \
                    stick_mass_kg energy_in_J energy_out_J\n"
        .to_owned();
    let classes = [("speed_m_s", 1.778, 2.371), ("angle_deg", 60.0, 65.0), ("diameter_m", 1e-4, 1.334e-4)];
    for (injector, share) in [("nozzle", 0.75), ("lance", 0.25)] {
        for (quantity, low, high) in classes {
            let part = share * scale;
            writeln!(
                text,
                "{time} {injector} {quantity} {low} {high} {} {} {} {} {} {} {} {} {}",
                100.0 * part,
                1000.0 * part,
                10_000.0 * part,
                1e-5 * part,
                60.0 * part,
                600.0 * part,
                6e-6 * part,
                2e-5 * part,
                1.8e-6 * part
            )
            .unwrap();
        }
    }
    text
}

/// A case with our wall model, restarted at 0.5 s, with stuck parcels at its last time.
pub(crate) fn ours(root: &Path) {
    skeleton(root, "nearWallInteraction");
    let tables = "postProcessing/nearWallInteraction/coalCloud1";
    write(
        root,
        &format!("{tables}/0/slagWall.dat"),
        &table(&[[0.1, 10.0, 1e-6, 8.0, 8e-7], [0.6, 99.0, 9e-6, 99.0, 9e-6]]),
    );
    write(
        root,
        &format!("{tables}/0.5/slagWall.dat"),
        &table(&[[0.55, 50.0, 5e-6, 30.0, 3e-6], [1.0, 100.0, 1e-5, 60.0, 6e-6]]),
    );
    write(root, &format!("{tables}/0/quenchWall.dat"), &table(&[[1.0, 40.0, 4e-6, 10.0, 1e-6]]));
    write(
        root,
        &format!("{tables}/0/balance.dat"),
        "# time_s injected_kg read_back_kg airborne_kg stuck_in_cloud_kg stuck_removed_kg escaped_kg reacted_kg \
         unusable_removed_kg residual\n1.0 1e-4 0 2e-5 7e-6 0 3e-5 4.3e-5 0 1e-14\n",
    );
    write(root, &format!("{tables}/0/slagWall.distributions.dat"), &distributions(0.6, 9.0));
    write(root, &format!("{tables}/0.5/slagWall.distributions.dat"), &distributions(1.0, 1.0));
    write(
        root,
        &format!("{tables}/0.5/slagWall.flux.dat"),
        "# time_s since_s injector area_m2 mass_flux_kg_m2_s stick_mass_flux_kg_m2_s\n1.0 0.5 0 1 1e-5 6e-6\n",
    );
    let foam =
        |body: &str| format!("FoamFile\n{{\n    format ascii;\n}}\n// * * * * //\n\n{body}\n\n// ***** //\n");
    let cloud = "1/lagrangian/coalCloud1";
    write(
        root,
        &format!("{cloud}/positions"),
        &foam("3\n(\n(0.2 0 -0.1) 5\n(0 0.2 -0.5) 6\n(-0.2 0 -0.9) 7\n)"),
    );
    write(root, &format!("{cloud}/active"), &foam("3\n(\n0\n1\n0\n)"));
    write(root, &format!("{cloud}/d"), &foam("3{1e-4}"));
    write(root, &format!("{cloud}/rho"), &foam("3(1000 1000 1000)"));
    write(root, &format!("{cloud}/nParticle"), &foam("3{10}"));
}

/// The same case with a stock model: slagWall holds all, quenchWall nothing.
pub(crate) fn stock(root: &Path) {
    skeleton(root, "localInteraction");
    let step = |time: f64, sticks: u32, mass: f64| {
        format!(
            "Time = {time}\n\nSolving 3-D cloud coalCloud1\n\nCloud: coalCloud1 injector: nozzle\n    Added 3 new parcels\n\n\
             Cloud: coalCloud1\n    Injector nozzle:\n      - parcels added               = 9\n\
             \x20     - mass introduced             = {}\n    Parcel fate: system (number, mass)\n\
             \x20     - escape                      = 5, 1e-05\n    Parcel fate: patch slagWall (number, mass)\n\
             \x20     - escape                      = 0, 0\n      - stick                       = {sticks}, {mass}\n\
             \x20   Parcel fate: patch (quenchWall|burnerWall) (number, mass)\n\
             \x20     - escape                      = 0, 0\n      - stick                       = 0, 0\n",
            1e-4 * time
        )
    };
    write(root, "log.coalChemistryFoam", &(step(0.5, 1, 1e-6) + &step(1.0, 2, 2e-6)));
    let header = "# Time currentProc  (position0 position1 position2) active nParticle d (U0 U1 U2) rho T mass0 \
                  N(Y0 Y1 Y2) N(YSolid0 YSolid1)\n";
    let row = |time: f64, carbon: f64| {
        format!(
            "{time} 0 (0.2 0 -0.3) 1 10 1e-4 (3 0 4) 1000 1500 1e-9 3(0 0 1) 2({carbon} {})\n",
            1.0 - carbon
        )
    };
    let hits = "postProcessing/lagrangian/coalCloud1/wallHits/0.2";
    write(root, &format!("{hits}/slagWall.post"), &(header.to_owned() + &row(0.3, 0.5) + &row(0.9, 0.1)));
    write(root, &format!("{hits}/quenchWall.post"), &(header.to_owned() + &row(0.7, 0.0)));
}

fn nearwall(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_nearwall")).current_dir(folder).args(arguments).output().unwrap()
}

fn two_cases() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    ours(&folder.path().join("ours"));
    stock(&folder.path().join("stock"));
    folder
}

fn names(walls: &[History<WallTotals>]) -> Vec<&str> {
    walls.iter().map(|wall| wall.wall.as_str()).collect()
}

fn times<T>(history: &History<T>) -> Vec<f64> {
    history.rows.iter().map(|(time, _)| *time).collect()
}

/// The line "escaped" of the mass balance [kg].
fn escaped_mass(results: &nearwall_lab::results::RunResults) -> Option<f64> {
    results.balance.iter().find(|line| line.what == "escaped").unwrap().mass
}

#[test]
fn tables_of_a_restarted_run_are_joined() {
    let folder = two_cases();
    let results = openfoam::read(&folder.path().join("ours")).unwrap();
    let [result] = &results[..] else { panic!("one cloud") };
    assert!(result.is_ours() && result.case == "ours" && result.cloud == "coalCloud1");
    let slag = result.wall("slagWall").unwrap();
    // The row at 0.6 s belongs to a run that was restarted at 0.5 s.
    assert_eq!(times(slag), [0.1, 0.55, 1.0]);
    let last = slag.at(1.0).unwrap();
    assert_eq!((last.hits.unwrap().count, last.captured), (100, Amount::new(60.0, 6e-6)));
    assert_eq!(last.regimes.unwrap().map(|amount| amount.mass()), [0.0, 6e-6, 0.0, 0.0]);
    assert_eq!(result.captures.len(), 2);
    assert_eq!(result.wall_patches, PATCHES);
    assert_eq!(result.injected_at(1.0), Some(1e-4));
}

#[test]
fn distributions_of_a_restarted_run_are_joined() {
    let folder = two_cases();
    let result = &openfoam::read(&folder.path().join("ours")).unwrap()[0];
    // The tables of classes and of flux are not taken for patches.
    assert_eq!(names(&result.walls), ["quenchWall", "slagWall"]);
    let [slag] = &result.classes[..] else { panic!("one patch") };
    // The rows at 0.6 s belong to a run that was restarted at 0.5 s.
    assert_eq!(times(slag), [1.0]);
    let classes = together(slag.at(1.0).unwrap(), ClassQuantity::Angle);
    assert_eq!((classes.len(), classes[0].low, classes[0].sums.hits), (1, 60.0, 100.0));
    let [share, low, high] = classes[0].sums.captured().unwrap();
    // Wilson's interval for 60 of 100.
    assert!((share - 0.6).abs() < 1e-12 && (low - 0.502).abs() < 5e-4 && (high - 0.6906).abs() < 5e-4);
}

#[test]
fn logs_and_arrivals_of_a_stock_model_are_read() {
    let folder = two_cases();
    let results = openfoam::read(&folder.path().join("stock")).unwrap();
    let result = &results[0];
    assert_eq!(result.wall_model, WallModel::Other("localInteraction".into()));
    assert_eq!(result.injected, [[0.5, 5e-5], [1.0, 1e-4]]);
    assert_eq!(result.totals("slagWall", 1.0).unwrap().captured.mass(), 2e-6);
    assert_eq!(result.wall("burnerWall").unwrap().wall, "(quenchWall|burnerWall)");
    let count = |wall: &str| result.recorded(wall).unwrap().hits.count;
    assert_eq!((count("slagWall"), count("quenchWall"), result.arrivals.len()), (2, 1, 2));
    // No patch counts an escape, the whole cloud does.
    assert_eq!(escaped_mass(result), Some(1e-5));
    let slag = result.recorded("slagWall").unwrap();
    let mass = 10.0 * std::f64::consts::PI / 6.0 * 1e-9;
    // Carbon is 0.5 and 0.1 of the solids: conversions 0.481 and 0.896.
    let expected = [4, 8].map(|class| (slag.conversions[class] - mass).abs() < 1e-20);
    assert_eq!((expected, slag.unknown_conversions), ([true; 2], 0));
    assert_eq!((slag.speed.mean, slag.speed.count), (5.0, 2));
    assert!(
        result.missing.iter().any(|what| what.contains("no parcels of coalCloud1")),
        "{:?}",
        result.missing
    );
}

#[test]
fn a_steady_case_speaks_of_iterations() {
    let folder = two_cases();
    let properties = folder.path().join("ours/constant/coalCloud1Properties");
    let text = std::fs::read_to_string(&properties).unwrap();
    std::fs::write(&properties, format!("{text}solution {{ transient no; }}\n")).unwrap();
    let results = openfoam::read(&folder.path().join("ours")).unwrap();
    let page = openfoam_page(&results).unwrap();
    assert!(page.contains("Results are those at iteration 1."), "no iteration in the lead");
    assert!(page.contains("The solve of iteration 1"), "no iteration above the table");
}

/// What, where, why and how sure; 60 of 100 have Wilson's interval from 0.5020 to 0.6906.
#[test]
fn the_page_opens_with_four_sentences_and_sets_few_hits_aside() {
    let folder = two_cases();
    let root = folder.path().join("ours");
    let tables = "postProcessing/nearWallInteraction/coalCloud1";
    write(&root, &format!("{tables}/0/quenchWall.dat"), &table(&[[1.0, 12.0, 4e-6, 3.0, 1e-6]]));
    let page = openfoam_page(&openfoam::read(&root).unwrap()).unwrap();
    let (verdict, rest) = page.split_once("<div class=\"verdict\">").unwrap().1.split_once("</div>").unwrap();
    for part in [
        "7.0 % of the injected mass is captured",
        "Most is captured by slagWall: 60.0 % of its 100 hits",
        "is caught as NSP-SW (non-sticky particles on a sticky wall)",
        "50.2 % to 69.1 % for the share captured by slagWall",
    ] {
        assert!(verdict.contains(part), "`{part}` is not in {verdict}");
    }
    assert_eq!(verdict.matches("<p>").count(), 4, "{verdict}");
    assert!(rest.contains("Walls with fewer than 30 hits, in no figure: quenchWall (12)."));
    assert_eq!(page.matches("quenchWall").count(), 1);
    let (_, heading) = rest.split_once("<h2 id=\"").unwrap();
    let (id, text) = heading.split_once("\">").unwrap();
    let text = text.split('<').next().unwrap();
    assert!(rest.contains(&format!("<a href=\"#{id}\">{text}</a>")), "{text} is not among the contents");
}

#[test]
fn without_captures_there_is_no_plot_of_them_over_time() {
    let folder = two_cases();
    let table_of = |start: &str| {
        folder.path().join(format!("ours/postProcessing/nearWallInteraction/coalCloud1/{start}"))
    };
    let page = || openfoam_page(&openfoam::read(&folder.path().join("ours")).unwrap()).unwrap();
    assert!(page().contains("Captured mass over time"));
    for start in ["0", "0.5"] {
        for patch in PATCHES {
            let path = table_of(start).join(format!("{patch}.dat"));
            if path.is_file() {
                std::fs::write(path, table(&[[0.1, 10.0, 1e-6, 0.0, 0.0], [1.0, 100.0, 1e-5, 0.0, 0.0]]))
                    .unwrap();
            }
        }
    }
    assert!(!page().contains("Captured mass over time"));
}

#[test]
fn the_page_compares_and_says_what_constants_get_wrong() {
    let folder = two_cases();
    let done = nearwall(folder.path(), &["report", "ours", "stock", "-o", "page.html"]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    for part in [
        "ours 7.0 %, stock 2.0 %",
        "Of the arriving mass ours holds 25.0 % at quenchWall, 60.0 % at slagWall, where stock holds all at slagWall and \
         nothing at quenchWall.",
        "caught as NSP-SW",
        "Regime of capture, ours",
        "no parcels of coalCloud1",
        ">lance<",
        ">9.0 %<",
    ] {
        assert!(page.contains(part), "`{part}` is not on the page");
    }
    for figure in [
        "by-wall",
        "regimes",
        "along",
        "history",
        "conversion",
        "arriving",
        "places-0",
        "speed-1",
        "angle-1",
        "size-1",
        "capture-1",
        "energy",
    ] {
        assert!(page.contains(&format!("<figure id=\"{figure}\"")), "no figure {figure}");
    }
    assert!(!page.contains(">outlet<"), "an outlet is no wall");
    is_self_contained(&page);
    // The same files, the same page.
    nearwall(folder.path(), &["report", "ours", "stock", "-o", "again.html"]);
    assert!(std::fs::read_to_string(folder.path().join("again.html")).unwrap() == page);
    // One case alone has its page beside it.
    assert_eq!(nearwall(folder.path(), &["report", "ours"]).status.code(), Some(0));
    assert!(folder.path().join("ours/report.html").is_file());
}

/// standardWallInteraction counts no escapes at patches; a log without the sum leaves the record of
/// what left, or nothing.
#[test]
fn escapes_that_no_log_counts_are_those_recorded_or_unknown() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("case");
    stock(&root);
    let log = std::fs::read_to_string(root.join("log.coalChemistryFoam")).unwrap();
    let without = log.replace(
        "    Parcel fate: system (number, mass)\n      - escape                      = 5, 1e-05\n",
        "",
    );
    assert!(without.len() < log.len());
    write(&root, "log.coalChemistryFoam", &without);
    assert_eq!(escaped_mass(&openfoam::read(&root).unwrap()[0]), None);
    write(
        &root,
        "postProcessing/lagrangian/coalCloud1/leaving/0.2/outlet.post",
        "# Time currentProc  (position0 position1 position2) active nParticle d (U0 U1 U2) rho\n\
         0.9 0 (0.2 0 -1.4) 1 10 1e-4 (3 0 4) 1000\n",
    );
    let mass = escaped_mass(&openfoam::read(&root).unwrap()[0]).unwrap();
    assert!((mass - 10.0 * 1000.0 * std::f64::consts::PI / 6.0 * 1e-12).abs() < 1e-20, "{mass}");
}

/// What a wall remembers has its figures; a case without has none, and its tables are no patches.
#[test]
fn walls_that_remember_show_their_history() {
    let folder = two_cases();
    let root = folder.path().join("ours");
    let tables = "postProcessing/nearWallInteraction/coalCloud1";
    let header = "# time_s initial_kg arrived_kg drained_kg from_other_patches_kg molten_kg powder_kg residual \
                  layer_thickness_mean_m layer_thickness_max_m coverage_mean coverage_max\n";
    let row = |time: f64, powder: f64| format!("{time} 0 2e-6 5e-7 0 1.25e-6 {powder} 0 1e-6 4e-6 0.1 0.4\n");
    write(
        &root,
        &format!("{tables}/0/slagWall.wall.dat"),
        &(header.to_owned() + &row(0.2, 1e-7) + &row(0.8, 9e-7)),
    );
    write(&root, &format!("{tables}/0.5/slagWall.wall.dat"), &(header.to_owned() + &row(0.6, 2e-7)));
    let nothing = "0.6 0 0 0 0 0 0 0 0 0 0 0\n";
    write(&root, &format!("{tables}/0.5/quenchWall.wall.dat"), &(header.to_owned() + nothing));
    let result = openfoam::read(&root).unwrap().remove(0);
    assert_eq!(names(&result.walls), ["quenchWall", "slagWall"]);
    let slag = result.deposits.iter().find(|history| history.wall == "slagWall").unwrap();
    let powder: Vec<f64> = slag.rows.iter().map(|(_, state)| deposit::value(state, "powder_kg")).collect();
    assert_eq!(powder, [1e-7, 2e-7]);
    let page = openfoam_page(&[result]).unwrap();
    for part in
        ["What lies on the walls over time", "Deposit on slagWall", "<figure id=\"wall-coverage\"", "drained"]
    {
        assert!(page.contains(part), "`{part}` is not on the page");
    }
    assert!(!page.contains("Deposit on quenchWall"));
    let stock = openfoam_page(&openfoam::read(&folder.path().join("stock")).unwrap()).unwrap();
    assert!(!stock.contains("What lies on the walls over time"));
}

#[test]
fn two_clouds_of_a_case_are_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let root = folder.path().join("case");
    ours(&root);
    let tables = "postProcessing/nearWallInteraction/limestone/0";
    write(&root, &format!("{tables}/slagWall.dat"), &table(&[[1.0, 20.0, 2e-6, 5.0, 5e-7]]));
    let page = openfoam_page(&openfoam::read(&root).unwrap()).unwrap();
    for part in [
        "Regime of capture, case coalCloud1",
        "Regime of capture, case limestone",
        "<figure id=\"regimes-1\"",
        "100 % of the captured mass of case limestone",
        "Captured parcels, case coalCloud1",
    ] {
        assert!(page.contains(part), "`{part}` is not on the page");
    }
}

/// Nothing is loaded: no address but the name of the SVG language, no script but the page's own, no image file.
fn is_self_contained(page: &str) {
    let without_names = page.replace("http://www.w3.org/2000/svg", "");
    for sign in ["http:", "https:", "src=", "<script ", "@import", "url(\"", "<link rel=\"stylesheet\""] {
        assert!(!without_names.contains(sign), "the page has `{sign}`");
    }
    assert_eq!(page.matches("<script>").count(), 1);
    assert!(without_names.matches("url(").count() == without_names.matches("url(#").count());
}

#[test]
fn folders_that_are_no_finished_cases_are_refused_with_the_remedy() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    skeleton(&folder.path().join("unrun"), "localInteraction");
    skeleton(&folder.path().join("cases/run/inner"), "localInteraction");
    let early = folder.path().join("early");
    skeleton(&early, "nearWallInteraction");
    let balance = "# time_s injected_kg\n0.02 0\n";
    write(&early, "postProcessing/nearWallInteraction/coalCloud1/0/balance.dat", balance);
    for (name, part) in [
        ("none", "there is no such folder"),
        ("empty", "not an OpenFOAM case (it has no system/controlDict)"),
        ("unrun", "no results found"),
        ("early", "no parcel was injected or hit a wall until its end"),
        ("cases", "Cases below it: cases/run/inner"),
    ] {
        let output = nearwall(folder.path(), &["report", name]);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.contains(name) && message.contains(part), "{message}");
    }
    assert_eq!(nearwall(folder.path(), &["report"]).status.code(), Some(2));
}

/// A real browser shows each figure with a size, and has nothing to complain about.
#[test]
fn a_browser_shows_every_figure() {
    let folder = two_cases();
    nearwall(folder.path(), &["report", "ours", "stock", "-o", "page.html"]);
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    // The copy for the test reports what the browser made of it in its title; the page itself has no script.
    let probe = "<script>window.onload = () => { const boxes = [...document.querySelectorAll('figure svg')].map(s => \
                 s.getBoundingClientRect()); const wide = document.documentElement.scrollWidth > innerWidth; \
                 document.title = 'PROBE ' + boxes.filter(b => b.width > 200 && b.height > 100).length + (wide ? \
                 ' TOO WIDE' : ''); };</script></body>";
    std::fs::write(folder.path().join("probe.html"), page.replace("</body>", probe)).unwrap();
    let Some(Seen { dom, complaints }) = browse(&folder.path().join("probe.html")) else { return };
    let figures = page.matches("<figure id=").count();
    assert!(figures >= 12);
    let start: String = dom.chars().take(600).collect();
    assert!(dom.contains(&format!("<title>PROBE {figures}</title>")), "{start}");
    assert!(complaints.is_empty(), "{complaints:?}");
}
