//! The plan of a batch: one JSON line per table, all that a machine needs to compute it.

use super::sweep::Sweep;
use super::{BatchError, invalid};
use crate::pending_file::PendingFile;
use crate::phase_table::variables::schema::FORMAT_VERSION;
use crate::scene::{Scene, SceneFile, SceneText, named_files};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::path::{Path, PathBuf};

/// Hexadecimal digits of an id: 80 bits, so that a million ids collide with 4e-13.
const ID_DIGITS: usize = 20;
/// From this many tables on, shards lie in 256 folders.
const MANY_TABLES: usize = 4096;

/// Longest line of a plan, bytes.
const LONGEST_LINE: u64 = 16 << 20;

/// One line of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedTable {
    /// Hash of the physics (the resolved scene, the content of the files that it names) and the version of the
    /// file format.
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

/// A plan in memory, or those of its tables that were asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchPlan {
    /// The tables, in the order of the plan.
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

    /// The id by what the named files hold at this moment.
    fn id_now(&self) -> Result<String, BatchError> {
        let mut hash = Sha256::new();
        hash.update(format!("gonio table {FORMAT_VERSION}\n"));
        hash.update(&self.scene);
        for path in named_files(&self.scene) {
            let content = std::fs::read(&path)
                .map_err(|source| BatchError::Io { path: path.clone(), source })?;
            hash.update(format!("\n{} {}\n", path.display(), content.len()));
            hash.update(content);
        }
        Ok(hexadecimal(&hash.finalize(), ID_DIGITS))
    }

    /// A table that is there belongs to the files of the plan's day.
    ///
    /// # Errors
    /// When a file that the scene names is gone or has changed since.
    pub(super) fn check_files(&self) -> Result<(), BatchError> {
        let files = named_files(&self.scene);
        if files.is_empty() || self.id_now()? == self.id {
            return Ok(());
        }
        let names: Vec<String> = files.iter().map(|path| path.display().to_string()).collect();
        Err(BatchError::Changed { id: self.id.clone(), files: names.join(", ") })
    }

    /// Where the table of this line lies in the folder of the shards.
    pub fn file(&self, folder: &Path) -> PathBuf {
        let tables: usize = self.shape.iter().product();
        let name = format!("{}.h5", self.id);
        // Ids are checked to be ASCII when a plan is read.
        if tables < MANY_TABLES { folder.join(name) } else { folder.join(&self.id[..2]).join(name) }
    }

    /// The table of line `number`.
    fn parse(text: &[u8], number: usize) -> Result<PlannedTable, String> {
        let table: PlannedTable =
            serde_json::from_slice(text).map_err(|error| error.to_string())?;
        table.check()?;
        if table.index == number {
            Ok(table)
        } else {
            Err(format!("it is number {} of the plan", table.index))
        }
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
            table.scene = scene.toml;
            table.id = table.id_now()?;
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
        BatchPlan::read_selected(path, Selection::All)
    }

    /// Read some lines of a plan. All of it goes into the digest, but only what is selected is
    /// parsed: a plan of ten thousand tables is read in milliseconds for one of them.
    ///
    /// # Errors
    /// As for [`BatchPlan::read`], and when there is no table of a wanted id.
    pub fn read_selected(path: &Path, selection: Selection<'_>) -> Result<BatchPlan, BatchError> {
        let wrong = |number: usize, message: String| BatchError::Plan {
            path: path.to_path_buf(),
            message: format!("line {}: {message}", number + 1),
        };
        let io = |source| BatchError::Io { path: path.to_path_buf(), source };
        let mut file = BufReader::with_capacity(1 << 16, File::open(path).map_err(io)?);
        let mut hash = Sha256::new();
        let (mut tables, mut line, mut lines) = (Vec::new(), Vec::new(), 0);
        loop {
            line.clear();
            let read = file.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line);
            if read.map_err(|error| wrong(lines, error.to_string()))? == 0 {
                break;
            }
            let text = line.strip_suffix(b"\n").unwrap_or(&line);
            if line.len() as u64 == LONGEST_LINE {
                return Err(wrong(lines, format!("longer than {LONGEST_LINE} bytes")));
            }
            hash.update(text);
            hash.update(b"\n");
            if selection.may_be(lines, text) {
                let table = PlannedTable::parse(text, lines);
                let table = table.map_err(|message| wrong(lines, message))?;
                if selection.is(&table) {
                    tables.push(table);
                }
            }
            lines += 1;
        }
        let plan = BatchPlan { digest: hexadecimal(&hash.finalize(), 64), tables };
        plan.check(lines, selection).map_err(|message| match selection {
            Selection::Id(id) if plan.tables.is_empty() && lines > 0 => {
                invalid("--id", id, "an id of the plan")
            }
            _ => BatchError::Plan { path: path.to_path_buf(), message },
        })?;
        Ok(plan)
    }

    /// Do as many lines as the file has fill the shape of the sweep?
    fn check(&self, lines: usize, selection: Selection<'_>) -> Result<(), String> {
        let Some(first) = self.tables.first() else {
            return match selection {
                Selection::Slice { .. } if lines > 0 => Ok(()),
                Selection::Id(_) if lines > 0 => Err("no such table".into()),
                _ => Err("the plan is empty".into()),
            };
        };
        let expected = first.shape.iter().try_fold(1usize, |product, &n| product.checked_mul(n));
        let same = self.tables.iter().all(|table| table.shape == first.shape);
        if expected != Some(lines) || !same {
            return Err(format!("{lines} lines do not fill {:?}", first.shape));
        }
        Ok(())
    }
}

/// Which tables of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selection<'a> {
    /// Every table.
    All,
    /// The table of this id.
    Id(&'a str),
    /// Every `parts`-th table, beginning with `number` (from 0).
    Slice {
        /// Which of the parts, from 0.
        number: usize,
        /// Of how many.
        parts: usize,
    },
}

impl Selection<'_> {
    /// False where the text of a line alone tells that it is not wanted.
    fn may_be(self, number: usize, text: &[u8]) -> bool {
        match self {
            Selection::All => true,
            Selection::Id(id) => memchr::memmem::find(text, id.as_bytes()).is_some(),
            Selection::Slice { number: first, parts } => number % parts.max(1) == first,
        }
    }

    fn is(self, table: &PlannedTable) -> bool {
        !matches!(self, Selection::Id(id) if id != table.id)
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

fn hexadecimal(bytes: &[u8], digits: usize) -> String {
    let text: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    text[..digits].to_string()
}
