//! Tables of drops that several pictures share: each is computed once.

use super::error::BowError;
use crate::phase_table::PhaseTable;
use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Tables of drops by what they are of.
///
/// ```
/// use gonio::render::bow::{BowScene, DropStore};
///
/// let scene: BowScene =
///     "[camera]\nwidth = 16\nheight = 9\n[[drops]]\nradius_mm = 0.005".parse().unwrap();
/// let store = DropStore::default();
/// let first = scene.draw_sharing(&store, ".".as_ref(), &|_| ())?;
/// assert_eq!(first, scene.draw_sharing(&store, ".".as_ref(), &|_| ())?);
/// assert_eq!(store.len(), 1);
/// # Ok::<(), gonio::render::bow::BowError>(())
/// ```
#[derive(Debug, Default)]
pub struct DropStore {
    tables: Mutex<HashMap<String, Arc<PhaseTable>>>,
    /// Least scattering angle of spheres, radians.
    least: f64,
}

impl DropStore {
    /// A store for pictures that see no scattering angle below this (radians): spheres are computed from there on.
    pub fn looking_from(least: f64) -> Self {
        Self { least, ..Self::default() }
    }

    /// Where tables of spheres begin unless that is later.
    pub(super) fn least(&self) -> f64 {
        self.least
    }

    /// Tables held.
    pub fn len(&self) -> usize {
        self.tables.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Whether there is none yet.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The table of a key, computed unless it is there.
    pub(super) fn get(
        &self,
        key: String,
        compute: impl FnOnce() -> Result<PhaseTable, BowError>,
    ) -> Result<Arc<PhaseTable>, BowError> {
        let lock = || self.tables.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = lock().get(&key) {
            return Ok(Arc::clone(table));
        }
        let table = Arc::new(compute()?);
        lock().insert(key, Arc::clone(&table));
        Ok(table)
    }
}
