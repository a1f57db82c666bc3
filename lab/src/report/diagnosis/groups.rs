//! Rows that share an error.

use super::super::format::{number, whole_percent};
use super::super::page::{Page, Table};
use crate::diagnose::{Diagnosis, GroupsFound};

pub(super) fn add(page: &mut Page, diagnosis: &Diagnosis) {
    let Some(groups) = &diagnosis.groups else { return };
    page.heading("Rows that share an error");
    page.text(sentence(groups));
    let names = ["e_n", "e_t"].into_iter().zip(groups.scatter).zip(groups.share);
    let rows: Vec<_> = names
        .filter(|((_, scatter), share)| *scatter > 0.0 && *share > 0.0)
        .map(|((name, scatter), share)| vec![name.to_owned(), number(scatter), whole_percent(share)])
        .collect();
    if !rows.is_empty() {
        let header =
            ["observable", "shared error, standard deviation [1]", "share of the residuals' variance"];
        page.table(Table::new("", 1, &header, rows));
    }
}

fn sentence(groups: &GroupsFound) -> String {
    let GroupsFound { column, count, declared, .. } = groups;
    let known = if *declared {
        "were declared as groups"
    } else {
        "were noticed as groups: residuals resemble each other more within them than chance allows"
    };
    format!(
        "The {count} values of {column} {known}. Rows of one group share an error, so they are not independent: \
            significance, intervals and hold-out go by group, and more groups narrow an interval, not more rows in \
            each."
    )
}
