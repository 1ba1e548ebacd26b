//! The plan of a batch: one JSON line per table, all that a machine needs to compute it.

use super::sweep::Sweep;
use super::{BatchError, invalid};
use crate::hdf5::FORMAT_VERSION;
use crate::pending_file::PendingFile;
use crate::scene::{Scene, SceneFile, SceneText};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Hexadecimal digits of an id: 80 bits, so that a million ids collide with 4e-13.
const ID_DIGITS: usize = 20;
/// From this many tables on, shards lie in 256 folders.
const MANY_TABLES: usize = 4096;

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedTable {
    /// Hash of the physics (the resolved scene) and the version of the file format.
    pub id: String,
    /// Number of the line, from 0.
    pub index: usize,
    /// Index per swept axis.
    pub position: Vec<usize>,
    /// Length of each axis.
    pub shape: Vec<usize>,
    /// Per axis, the swept values by dotted key.
    pub values: Vec<BTreeMap<String, serde_json::Value>>,
    /// The scene, as TOML.
    pub scene: String,
}

/// A plan in memory.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchPlan {
    pub tables: Vec<PlannedTable>,
    /// Hash of the whole plan.
    pub digest: String,
}

impl PlannedTable {
    /// The validated scene.
    ///
    /// # Errors
    /// When the scene is not valid.
    pub fn scene(&self) -> Result<Scene, BatchError> {
        let name = format!("table {} of the plan", self.index);
        let text = SceneText::parse(&name, self.scene.clone())?;
        Ok(Scene::from_text(text, &SceneFile::default())?)
    }

    /// Where the table of this line lies in the folder of the shards.
    pub fn file(&self, folder: &Path) -> PathBuf {
        let tables: usize = self.shape.iter().product();
        let name = format!("{}.h5", self.id);
        // Ids are checked to be ASCII when a plan is read.
        if tables < MANY_TABLES { folder.join(name) } else { folder.join(&self.id[..2]).join(name) }
    }

    fn check(&self) -> Result<(), String> {
        let hexadecimal = self.id.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b));
        if self.id.len() != ID_DIGITS || !hexadecimal {
            return Err(format!("id {:?} is not {ID_DIGITS} hexadecimal digits", self.id));
        }
        let inside = self.position.len() == self.shape.len()
            && self.values.len() == self.shape.len()
            && self.position.iter().zip(&self.shape).all(|(i, n)| i < n);
        if !inside {
            return Err(format!("position {:?} is not inside {:?}", self.position, self.shape));
        }
        Ok(())
    }
}

impl BatchPlan {
    /// Plan a sweep; every scene is validated.
    ///
    /// # Errors
    /// When the sweep or a scene of it is wrong; the first wrong scene is named.
    pub fn from_sweep(sweep: &Sweep) -> Result<BatchPlan, BatchError> {
        let tables = (0..sweep.points()).map(|index| {
            let position = sweep.position(index);
            let scene_text = sweep.scene(&position);
            let mut table = PlannedTable {
                id: String::new(),
                index,
                values: values_at(sweep, &position),
                position,
                shape: sweep.shape(),
                scene: scene_text,
            };
            let scene = table.scene()?;
            table.id = id_of(&scene);
            table.scene = scene.toml;
            Ok(table)
        });
        let tables: Vec<PlannedTable> = tables.collect::<Result<_, BatchError>>()?;
        let mut hash = Sha256::new();
        tables.iter().for_each(|table| hash.update(line(table)));
        Ok(BatchPlan { tables, digest: hexadecimal(&hash.finalize(), 64) })
    }

    /// Write the plan, one line per table.
    ///
    /// # Errors
    /// When the file exists (without `overwrite`) or cannot be written.
    pub fn write(&self, path: &Path, overwrite: bool) -> Result<(), BatchError> {
        if path.exists() && !overwrite {
            return Err(crate::hdf5::TableError::Exists { path: path.into() }.into());
        }
        let io = |source| BatchError::Io { path: path.to_path_buf(), source };
        let pending = PendingFile::create(path).map_err(io)?;
        let write = || {
            let mut file = BufWriter::new(File::create(pending.path())?);
            self.tables.iter().try_for_each(|table| file.write_all(&line(table)))?;
            file.flush()
        };
        write().map_err(io)?;
        pending.commit().map_err(io)
    }

    /// Read a plan.
    ///
    /// # Errors
    /// When the file cannot be read or a line is no planned table; the line is named.
    pub fn read(path: &Path) -> Result<BatchPlan, BatchError> {
        let wrong = |number: usize, message: String| BatchError::Plan {
            path: path.to_path_buf(),
            message: format!("line {}: {message}", number + 1),
        };
        let io = |source| BatchError::Io { path: path.to_path_buf(), source };
        let file = BufReader::new(File::open(path).map_err(io)?);
        let mut hash = Sha256::new();
        let mut tables = Vec::new();
        for (number, text) in file.lines().enumerate() {
            let text = text.map_err(|error| wrong(number, error.to_string()))?;
            let table: PlannedTable =
                serde_json::from_str(&text).map_err(|error| wrong(number, error.to_string()))?;
            table.check().map_err(|message| wrong(number, message))?;
            if table.index != number {
                return Err(wrong(number, format!("it is number {} of the plan", table.index)));
            }
            hash.update(text.as_bytes());
            hash.update(b"\n");
            tables.push(table);
        }
        let Some(first) = tables.first() else {
            let message = "the plan is empty".to_string();
            return Err(BatchError::Plan { path: path.to_path_buf(), message });
        };
        let expected = first.shape.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        let same = tables.iter().all(|table| table.shape == first.shape);
        if expected != Some(tables.len()) || !same {
            let message = format!("{} lines do not fill {:?}", tables.len(), first.shape);
            return Err(BatchError::Plan { path: path.to_path_buf(), message });
        }
        Ok(BatchPlan { digest: hexadecimal(&hash.finalize(), 64), tables })
    }

    /// The table of this id.
    ///
    /// # Errors
    /// When there is none.
    pub fn by_id(&self, id: &str) -> Result<&PlannedTable, BatchError> {
        let found = self.tables.iter().find(|table| table.id == id);
        found.ok_or_else(|| invalid("--id", id, "an id of the plan"))
    }

    /// The part `number` of `parts` (numbers from 0): every `parts`-th table.
    pub fn slice(&self, number: usize, parts: usize) -> impl Iterator<Item = &PlannedTable> {
        self.tables.iter().skip(number).step_by(parts.max(1))
    }
}

fn values_at(sweep: &Sweep, position: &[usize]) -> Vec<BTreeMap<String, serde_json::Value>> {
    let along = |(axis, &at): (&super::Axis, &usize)| {
        let pairs = axis.keys.iter().zip(&axis.values);
        let json = |value: &toml::Value| serde_json::to_value(value).unwrap_or_default();
        pairs.map(|(key, values)| (key.clone(), json(&values[at]))).collect()
    };
    sweep.axes.iter().zip(position).map(along).collect()
}

fn line(table: &PlannedTable) -> Vec<u8> {
    // Strings and numbers always have a JSON form.
    let mut line = serde_json::to_vec(table).unwrap_or_default();
    line.push(b'\n');
    line
}

fn id_of(scene: &Scene) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("gonio table {FORMAT_VERSION}\n"));
    hash.update(&scene.toml);
    hexadecimal(&hash.finalize(), ID_DIGITS)
}

fn hexadecimal(bytes: &[u8], digits: usize) -> String {
    let text: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    text[..digits].to_string()
}
