//! What is wrong with a layer.

use crate::fault::{Blame, Fault};

/// A layer that cannot be: the field, its value and what is accepted.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{field} = {value}: accepted are {accepted}")]
pub struct TransferError {
    /// Of the layer, the sun or the settings.
    pub field: &'static str,
    /// As given.
    pub value: f64,
    /// What would do.
    pub accepted: &'static str,
}

impl Blame for TransferError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}
