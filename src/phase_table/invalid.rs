//! What is wrong with a table.

use crate::fault::{Blame, Fault};

/// What is wrong with a table or its header: the field, the value, what is accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} = {value}: {accepted}")]
pub struct InvalidTable {
    /// What is wrong.
    pub field: String,
    /// Its value.
    pub value: String,
    /// What would do.
    pub accepted: String,
}

impl Blame for InvalidTable {
    fn fault(&self) -> Fault {
        Fault::Run
    }
}

pub(super) fn invalid(field: &str, value: impl ToString, accepted: &str) -> InvalidTable {
    InvalidTable { field: field.into(), value: value.to_string(), accepted: accepted.into() }
}
