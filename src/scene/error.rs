//! What can be wrong with a scene, said so that it can be put right: where, which value, what is
//! accepted.

use crate::fault::{Blame, Fault};
use crate::medium::MediumError;
use std::fmt;
use std::path::PathBuf;

/// Where a value of a scene came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// A key of a scene that was built in memory, such as `particle.radius_mm`.
    Key {
        /// Dotted, as `particle.radius_mm`.
        key: String,
    },
    /// A key in a file, or the file as a whole where `key` is empty.
    File {
        /// Its name.
        file: String,
        /// From 1, where it is known.
        line: Option<usize>,
        /// Dotted, as `particle.radius_mm`.
        key: String,
    },
    /// A flag of the command line, such as `--radius-mm`.
    Flag {
        /// As `--radius-mm`.
        flag: String,
    },
}

impl Place {
    fn key(key: &str) -> Box<Place> {
        Box::new(Place::Key { key: key.into() })
    }

    /// The flag of a dotted key: `particle.radius_mm` → `--radius-mm`.
    pub fn flag(key: &str) -> Place {
        let name = key.rsplit('.').next().unwrap_or(key);
        Place::Flag { flag: format!("--{}", name.replace('_', "-")) }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Place::Key { key } => write!(f, "{key}"),
            Place::Flag { flag } => write!(f, "{flag}"),
            Place::File { file, line, key } => {
                write!(f, "{file}")?;
                if let Some(line) = line {
                    write!(f, ", line {line}")?;
                }
                if key.is_empty() { Ok(()) } else { write!(f, ": {key}") }
            }
        }
    }
}

/// Why a scene was refused.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the messages say what each case and field is")]
pub enum SceneError {
    #[error("{}: cannot read the scene: {source}", path.display())]
    Read { path: PathBuf, source: std::io::Error },
    #[error("{place}: {message}")]
    Syntax { place: Box<Place>, message: String },
    #[error("{place}: unknown key `{key}`{}; known here: {known}", did_you_mean(suggestion))]
    UnknownKey { place: Box<Place>, key: String, suggestion: Option<String>, known: String },
    #[error(
        "{place}: this is the scene of a picture, which `gonio render` draws; that of a table has {sections}"
    )]
    OfPicture { place: Box<Place>, sections: String },
    #[error("{place} = {value}: {accepted}")]
    Invalid { place: Box<Place>, value: String, accepted: String },
    #[error("{place} is missing: {accepted}")]
    Missing { place: Box<Place>, accepted: String },
    #[error("{place}: {source}")]
    Medium { place: Box<Place>, source: MediumError },
}

impl Blame for SceneError {
    fn fault(&self) -> Fault {
        Fault::Input
    }
}

impl SceneError {
    pub(super) fn invalid(
        key: &str,
        value: impl fmt::Display,
        accepted: impl Into<String>,
    ) -> Self {
        SceneError::Invalid {
            place: Place::key(key),
            value: shown(&value.to_string()),
            accepted: accepted.into(),
        }
    }

    pub(super) fn missing(key: &str, accepted: impl Into<String>) -> Self {
        SceneError::Missing { place: Place::key(key), accepted: accepted.into() }
    }

    pub(super) fn medium(key: &str, source: MediumError) -> Self {
        SceneError::Medium { place: Place::key(key), source }
    }

    /// The same error of one of several kinds of particles: `particle.shape` → `particles[2].shape`, counted
    /// from 1.
    pub(super) fn of_mode(self, place: usize) -> Self {
        let number = place + 1;
        self.placed(|key| {
            let name = key.strip_prefix("particle.").unwrap_or(key);
            Place::Key { key: format!("particles[{number}].{name}") }
        })
    }

    /// The same error of a scene that has no lines.
    pub(super) fn without_line(mut self) -> Self {
        if let SceneError::Syntax { place, .. } | SceneError::UnknownKey { place, .. } = &mut self
            && let Place::File { line, .. } = &mut **place
        {
            *line = None;
        }
        self
    }

    /// The same error with its bare key replaced by the place that the key came from.
    pub(super) fn placed(mut self, place_of: impl Fn(&str) -> Place) -> Self {
        match &mut self {
            SceneError::Read { .. } => {}
            SceneError::Syntax { place, .. }
            | SceneError::UnknownKey { place, .. }
            | SceneError::OfPicture { place, .. }
            | SceneError::Invalid { place, .. }
            | SceneError::Missing { place, .. }
            | SceneError::Medium { place, .. } => {
                if let Place::Key { key } = &**place {
                    **place = place_of(key);
                }
            }
        }
        self
    }
}

/// A value for a message: numbers of hundreds of digits by their power of ten, long lists cut.
pub(crate) fn shown(value: &str) -> String {
    const LONG: usize = 24;
    const LONGEST: usize = 120;
    match value.parse::<f64>() {
        Ok(number) if value.len() > LONG => format!("{number:e}"),
        _ if value.chars().count() > LONGEST => {
            format!("{}…", value.chars().take(LONGEST).collect::<String>())
        }
        _ => value.into(),
    }
}

fn did_you_mean(suggestion: &Option<String>) -> String {
    suggestion.as_ref().map(|s| format!(" (did you mean `{s}`?)")).unwrap_or_default()
}

/// The candidate most like `word`, if any is like it at all.
pub(super) fn nearest<'a>(
    word: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    /// Jaro–Winkler similarity below which a suggestion would only confuse.
    const ALIKE: f64 = 0.75;
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(word, candidate), candidate))
        .filter(|(likeness, _)| *likeness > ALIKE)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}
