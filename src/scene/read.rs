//! From the text of a scene file to `SceneFile`, remembering the lines.

use super::error::{Place, SceneError, nearest};
use super::file::{KEYS, MODES, ModeKeys, SceneFile};
use super::files::read_limited;
use super::shipped::SceneKind;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::de::DeTable;

/// A scene file that could be read, with its text for finding lines.
#[derive(Clone, Debug)]
pub struct SceneText {
    /// Name for messages: the path as the user gave it.
    pub name: String,
    /// Folder of the file, where the files that it names are looked for.
    pub folder: PathBuf,
    text: String,
    /// Whether lines of the text mean something to whoever wrote the scene.
    numbered: bool,
    /// The keys.
    pub file: SceneFile,
}

impl SceneText {
    /// Read a scene file.
    ///
    /// # Errors
    /// The file cannot be read, is no TOML, or has unknown keys or values of the wrong kind.
    pub fn load(path: &Path) -> Result<SceneText, SceneError> {
        let unreadable = |source| SceneError::Read { path: path.to_path_buf(), source };
        let text = read_limited(path).map_err(unreadable)?;
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(SceneText { folder, ..SceneText::parse(&path.display().to_string(), text)? })
    }

    /// Parse the text of a scene; `name` stands for it in messages.
    ///
    /// # Errors
    /// As for [`SceneText::load`].
    pub fn parse(name: &str, text: String) -> Result<SceneText, SceneError> {
        let syntax = |error: toml::de::Error| {
            let span = error.span();
            let key = span.clone().and_then(|span| key_at(&text, span.start)).unwrap_or_default();
            let line = span.map(|span| line_at(&text, span.start));
            let message = error.message().trim().replace('\n', ", ");
            let place = Box::new(Place::File { file: name.into(), line, key });
            SceneError::Syntax { place, message }
        };
        let document = DeTable::parse(&text).map_err(syntax)?;
        if SceneKind::of(&text) == Some(SceneKind::Picture) {
            let place = Box::new(Place::File { file: name.into(), line: None, key: String::new() });
            return Err(SceneError::OfPicture { place, sections: sections() });
        }
        check_keys(name, &text, document.get_ref())?;
        let file = toml::from_str(&text).map_err(syntax)?;
        Ok(SceneText { name: name.into(), folder: PathBuf::new(), text, numbered: true, file })
    }

    /// A scene that is no text but keys and values, such as a program has; `name` stands for it in messages.
    ///
    /// ```
    /// use gonio::scene::{Scene, SceneFile, SceneText};
    ///
    /// let keys: toml::Table = toml::from_str("particle = { shape = 'sphere', radius_um = -1 }")?;
    /// let error = Scene::from_text(SceneText::of_keys("scene", &keys)?, &SceneFile::default()).unwrap_err();
    /// assert!(error.to_string().starts_with("scene: particle.radius_um = -1: "), "{error}");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Unknown keys or values of the wrong kind.
    pub fn of_keys(name: &str, keys: &toml::Table) -> Result<SceneText, SceneError> {
        let text = SceneText::parse(name, keys.to_string());
        let text = text.map_err(SceneError::without_line)?;
        Ok(SceneText { numbered: false, ..text })
    }

    /// The place of a dotted key in this file.
    pub fn place_of(&self, key: &str) -> Place {
        let span = self.span_of(key).filter(|_| self.numbered);
        let line = span.map(|span| line_at(&self.text, span.start));
        Place::File { file: self.name.clone(), line, key: key.into() }
    }

    fn span_of(&self, key: &str) -> Option<Range<usize>> {
        let document = DeTable::parse(&self.text).ok()?;
        let (section, name) = key.split_once('.')?;
        let keys = match section.strip_suffix(']').and_then(|section| section.split_once('[')) {
            // one of several kinds of particles, counted from 1
            Some((section, number)) => {
                let modes = get(document.get_ref(), section)?.as_array()?;
                modes.get(number.parse::<usize>().ok()?.checked_sub(1)?)?.get_ref().as_table()?
            }
            None => get(document.get_ref(), section)?.as_table()?,
        };
        keys.iter().find(|(key, _)| key.get_ref() == name).map(|(key, _)| key.span())
    }
}

fn get<'a, 'i>(table: &'a DeTable<'i>, name: &str) -> Option<&'a toml::de::DeValue<'i>> {
    table.iter().find(|(key, _)| key.get_ref() == name).map(|(_, value)| value.get_ref())
}

/// Refuse the first unknown section or key, with the nearest known one.
fn check_keys(name: &str, text: &str, document: &DeTable) -> Result<(), SceneError> {
    let unknown = |span: Range<usize>, key: &str, known: Vec<&str>| {
        let line = Some(line_at(text, span.start));
        Err(SceneError::UnknownKey {
            place: Box::new(Place::File { file: name.into(), line, key: String::new() }),
            key: key.into(),
            suggestion: nearest(key, known.iter().copied()).map(String::from),
            known: known.join(", "),
        })
    };
    for (section, value) in document {
        if section.get_ref() == MODES {
            let known = ModeKeys::keys();
            let modes = value.get_ref().as_array().into_iter().flatten();
            for (key, _) in modes.filter_map(|mode| mode.get_ref().as_table()).flatten() {
                if !known.contains(&&**key.get_ref()) {
                    return unknown(key.span(), key.get_ref(), known);
                }
            }
            continue;
        }
        let Some((_, known)) = KEYS.iter().find(|(name, _)| name == section.get_ref()) else {
            // A key that was written above its section's head is the likelier slip.
            if let Some((home, _)) =
                KEYS.iter().find(|(_, keys)| keys.contains(&&**section.get_ref()))
            {
                let mut error = unknown(section.span(), section.get_ref(), vec![]);
                if let Err(SceneError::UnknownKey { suggestion, known, .. }) = &mut error {
                    *suggestion = Some(format!("{home}.{}", section.get_ref()));
                    *known = sections();
                }
                return error;
            }
            let sections = KEYS.iter().map(|(name, _)| *name).chain([MODES]).collect();
            return unknown(section.span(), section.get_ref(), sections);
        };
        for (key, _) in value.get_ref().as_table().into_iter().flatten() {
            if !known.contains(&&**key.get_ref()) {
                return unknown(key.span(), key.get_ref(), known.to_vec());
            }
        }
    }
    Ok(())
}

/// The sections that scenes have.
fn sections() -> String {
    KEYS.map(|(name, _)| format!("[{name}]")).join(", ")
}

/// The dotted key whose value covers a byte of the text.
fn key_at(text: &str, byte: usize) -> Option<String> {
    let document = DeTable::parse(text).ok()?;
    for (section, value) in document.get_ref() {
        for (key, value) in value.get_ref().as_table().into_iter().flatten() {
            if value.span().contains(&byte) || key.span().contains(&byte) {
                return Some(format!("{}.{}", section.get_ref(), key.get_ref()));
            }
        }
    }
    None
}

/// Line number, from 1, of a byte of the text.
pub(crate) fn line_at(text: &str, byte: usize) -> usize {
    text.bytes().take(byte).filter(|byte| *byte == b'\n').count() + 1
}
