//! The wall of the model that a row of a file hits.

use nearwall::model::Model;

/// Why a wall cannot be chosen.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum WallError {
    /// The wall given by the user is not in the model.
    #[error("--wall {name}: the model has no such wall; its walls are {walls}")]
    NotInModel {
        /// The wall given by the user.
        name: String,
        /// The model's walls.
        walls: String,
    },
    /// The wall is undetermined.
    #[error("the wall is undetermined; give --wall with one of: {walls}")]
    Undecided {
        /// The model's walls.
        walls: String,
    },
    /// A row hits a wall that the model does not have.
    #[error("the model has no wall `{0}` and no default")]
    Unknown(String),
}

/// Finds the wall of each row: the one given by the user, else that of the row, else `default`, else the only one.
pub struct WallChoice<'a> {
    model: &'a Model,
    /// The wall of rows that name none.
    common: Option<usize>,
    /// Whether the user gives the wall of all rows.
    fixed: bool,
}

impl<'a> WallChoice<'a> {
    /// A choice among the walls of `model`; `named` is the wall that the user gives for all rows.
    ///
    /// # Errors
    /// [`WallError::NotInModel`].
    pub fn new(model: &'a Model, named: Option<&str>) -> Result<Self, WallError> {
        if let Some(name) = named {
            let wall = model
                .find_wall(name)
                .ok_or_else(|| WallError::NotInModel { name: name.to_owned(), walls: wall_names(model) })?;
            return Ok(Self { model, common: Some(wall), fixed: true });
        }
        let only = (model.walls().len() == 1).then_some(0);
        Ok(Self { model, common: model.find_wall("default").or(only), fixed: false })
    }

    /// The model.
    pub(super) fn model(&self) -> &'a Model {
        self.model
    }

    /// Checks that every row has a wall; `column` tells whether the file has a column of walls.
    ///
    /// # Errors
    /// [`WallError::Undecided`].
    pub fn check(&self, column: bool) -> Result<(), WallError> {
        if self.common.is_none() && !column {
            return Err(WallError::Undecided { walls: wall_names(self.model) });
        }
        Ok(())
    }

    /// The wall of a row with this cell. As in OpenFOAM, `default` applies to walls that the model does not name.
    ///
    /// # Errors
    /// [`WallError::Unknown`].
    pub fn of(&self, cell: Option<&str>) -> Result<usize, WallError> {
        let named = cell.filter(|name| !self.fixed && !name.is_empty());
        let found = match named {
            Some(name) => self.model.find_wall(name).or_else(|| self.model.find_wall("default")),
            None => self.common,
        };
        found.ok_or_else(|| WallError::Unknown(named.unwrap_or_default().to_owned()))
    }
}

fn wall_names(model: &Model) -> String {
    model.walls().iter().map(|wall| wall.name()).collect::<Vec<_>>().join(", ")
}
