//! Reading files that hold the extinction coefficient k and no n.

use crate::medium::data::extinction::Extinction;
use crate::medium::data::table::name_of;
use crate::medium::error::MediumError;
use crate::medium::read::csv_table;
use crate::medium::read::ending::has_ending;
use crate::medium::read::refractive_index_info::{self, Data};
use std::path::Path;

impl Extinction {
    /// Reads a file that resolving refused with [`MediumError::OnlyExtinction`]; `None` for one that
    /// has n.
    pub fn read(path: &Path) -> Result<Option<Self>, MediumError> {
        if has_ending(path, &["csv", "txt", "tsv"]) {
            let table = csv_table::read(path)?;
            let only = table.n.is_empty() && !table.k.is_empty();
            let extinction =
                || Self::new(name_of(path), table.source, table.notes, table.k.curve());
            return Ok(only.then(extinction));
        }
        match refractive_index_info::read_data(path)? {
            Data::Extinction(extinction) => Ok(Some(extinction)),
            Data::Material(_) => Ok(None),
        }
    }
}
