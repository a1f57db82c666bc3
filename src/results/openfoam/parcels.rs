//! The captured parcels of a cloud at the last written time.
//!
//! `<time>/lagrangian/<cloud>/positions`, `active`, `d`, `rho`, `nParticle`, and the deposit of `nearWallInteraction`,
//! `<time>/lagrangian/<cloud>Deposit/positions`, `d`, `mass`, written as ASCII. Binary and compressed files are not
//! read; the page then states it.

use std::f64::consts::PI;
use std::path::Path;

use super::super::Capture;
use super::time_folders;

/// Reads the parcels that lie still at the last time that has any parcels, in the cloud or in its deposit.
///
/// # Errors
/// Why they cannot be read, for the page.
pub fn read_last(case: &Path, cloud: &str) -> Result<Vec<Capture>, String> {
    let folders = time_folders(case).into_iter().rev().map(|(_, time)| {
        let lagrangian = time.join("lagrangian");
        (lagrangian.join(cloud), lagrangian.join(format!("{cloud}Deposit")))
    });
    let Some((own, deposit)) = folders.into_iter().find(|(own, deposit)| own.is_dir() || deposit.is_dir())
    else {
        let hint = if case.join("processor0").is_dir() { " (run reconstructPar)" } else { "" };
        return Err(format!(
            "no parcels of {cloud} at a written time{hint}, so the places of captured parcels are unknown"
        ));
    };
    // OpenFOAM writes no folder for a cloud that is empty
    let mut parcels = if own.is_dir() { read_cloud(&own)? } else { Vec::new() };
    if deposit.is_dir() {
        parcels.extend(read_deposit(&deposit)?);
    }
    Ok(parcels)
}

fn read_cloud(folder: &Path) -> Result<Vec<Capture>, String> {
    let positions = positions(folder)?;
    let numbers = |name: &str| numbers(folder, name, positions.len());
    let (active, diameters, densities) = (numbers("active")?, numbers("d")?, numbers("rho")?);
    let particles = numbers("nParticle").unwrap_or_default();
    let parcels = positions.iter().enumerate().filter_map(|(index, position)| {
        let diameter = *diameters.get(index)?;
        let count = particles.get(index).copied().unwrap_or(1.0);
        let mass = count * PI / 6.0 * diameter.powi(3) * densities.get(index)?;
        (*active.get(index)? == 0.0).then(|| capture(*position, mass, diameter))
    });
    Ok(parcels.collect())
}

fn read_deposit(folder: &Path) -> Result<Vec<Capture>, String> {
    let positions = positions(folder)?;
    let numbers = |name: &str| numbers(folder, name, positions.len());
    let (diameters, masses) = (numbers("d")?, numbers("mass")?);
    let parcels = positions.iter().zip(diameters).zip(masses);
    Ok(parcels.map(|((position, diameter), mass)| capture(*position, mass, diameter)).collect())
}

fn capture(position: [f64; 3], mass: f64, diameter: f64) -> Capture {
    Capture { wall: None, position, mass, diameter, regime: None }
}

fn positions(folder: &Path) -> Result<Vec<[f64; 3]>, String> {
    let place = |entry: &String| {
        let mut words = entry.trim_start_matches('(').split([' ', ')']).filter_map(|word| word.parse().ok());
        Some([words.next()?, words.next()?, words.next()?])
    };
    Ok(entries(folder, "positions", None)?.iter().filter_map(place).collect())
}

fn numbers(folder: &Path, name: &str, parcels: usize) -> Result<Vec<f64>, String> {
    Ok(entries(folder, name, Some(parcels))?.iter().filter_map(|entry| entry.parse().ok()).collect())
}

fn entries(folder: &Path, name: &str, parcels: Option<usize>) -> Result<Vec<String>, String> {
    let path = folder.join(name);
    let unreadable = || {
        format!("{} is absent or not ASCII, so the places of captured parcels are unknown", path.display())
    };
    std::fs::read_to_string(&path).ok().and_then(|text| list(&text, parcels)).ok_or_else(unreadable)
}

/// The entries of an OpenFOAM list file: one a line between brackets, or `n{value}` for `n` equal entries. More equal
/// entries than parcels are cut off, and without a number of parcels such a list is refused: a short text must not fill
/// the memory.
fn list(text: &str, parcels: Option<usize>) -> Option<Vec<String>> {
    let body = text.split_once("// * *").map_or(text, |(_, rest)| rest);
    let body: Vec<&str> = body
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with(['/', '*']))
        .collect();
    let first = body.first()?;
    if let Some((count, value)) = first.split_once('{') {
        let count: usize = count.trim().parse().ok()?;
        return Some(vec![value.trim_end_matches('}').to_owned(); count.min(parcels?)]);
    }
    if let Some((count, rest)) = first.split_once('(') {
        count.trim().parse::<usize>().ok()?;
        return Some(rest.trim_end_matches(')').split_whitespace().map(str::to_owned).collect());
    }
    first.parse::<usize>().ok()?;
    let inside =
        body.iter().skip(1).skip_while(|line| **line != "(").skip(1).take_while(|line| **line != ")");
    Some(inside.map(|line| (*line).to_owned()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_of_a_list_is_read() {
        let head = "FoamFile\n{\n format ascii;\n}\n// * * * * //\n\n";
        assert_eq!(
            list(&format!("{head}2\n(\n(0 1 2) 7\n(3 4 5) 8\n)\n\n// ***\n"), None).unwrap(),
            ["(0 1 2) 7", "(3 4 5) 8"]
        );
        assert_eq!(list(&format!("{head}3{{1e-3}}\n"), Some(3)).unwrap(), ["1e-3"; 3]);
        assert_eq!(list(&format!("{head}268435455{{1e-3}}\n"), Some(2)).unwrap(), ["1e-3"; 2]);
        assert_eq!(list(&format!("{head}268435455{{(0 0 0)}}\n"), None), None);
        assert_eq!(list(&format!("{head}2(0 1)\n"), Some(2)).unwrap(), ["0", "1"]);
        assert_eq!(list(&format!("{head}0()\n"), Some(0)).unwrap(), Vec::<String>::new());
        assert_eq!(list("no list", Some(2)), None);
    }

    #[test]
    fn parcels_of_the_deposit_are_read_when_the_cloud_is_empty() {
        let case = tempfile::tempdir().unwrap();
        let write = |path: &str, body: &str| {
            let path = case.path().join(path);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, format!("FoamFile\n{{\n}}\n// * * * //\n\n{body}\n")).unwrap();
        };
        for (file, body) in
            [("positions", "1\n(\n(1 2 3) 0\n)"), ("active", "1{1}"), ("d", "1{2e-3}"), ("rho", "1{1000}")]
        {
            write(&format!("0.1/lagrangian/coal/{file}"), body);
        }
        for (file, body) in
            [("positions", "2\n(\n(0 0 1) 7\n(0 0 2) 8\n)"), ("d", "2{1e-4}"), ("mass", "2(3e-6 4e-6)")]
        {
            write(&format!("0.2/lagrangian/coalDeposit/{file}"), body);
        }
        let parcels = read_last(case.path(), "coal");
        let lying = |z, mass| capture([0.0, 0.0, z], mass, 1e-4);
        assert_eq!(parcels.unwrap(), [lying(1.0, 3e-6), lying(2.0, 4e-6)]);
    }
}
