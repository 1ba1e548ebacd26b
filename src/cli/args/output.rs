//! Where results go: looked at before anything is computed.

use crate::cli::failure::{Failure, Result};
use std::path::Path;

/// What a file is to be.
pub struct Output<'a> {
    /// The flag that names it.
    pub flag: &'a str,
    /// Its path.
    pub path: &'a Path,
    /// The kind of file that is written, and the endings of its name; none: any.
    pub kind: &'a str,
    /// Without the point, in small letters.
    pub endings: &'a [&'a str],
}

impl Output<'_> {
    /// Refuses a name that promises another kind of file, a folder that is not there, or a folder in place of a file.
    pub fn check(&self) -> Result<()> {
        let Self { flag, path, kind, endings } = self;
        let shown = path.display();
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
        if !endings.is_empty() && !endings.contains(&ending.as_str()) {
            let accepted: Vec<String> = endings.iter().map(|ending| format!(".{ending}")).collect();
            let message = format!("{flag} = {shown}: {kind} is written; give it the ending");
            return Err(Failure::usage(format!("{message} {}", accepted.join(" or "))));
        }
        if path.is_dir() {
            return Err(Failure::usage(format!("{flag} = {shown}: a folder; name a file in it")));
        }
        self.check_folder()
    }

    /// Refuses a folder that is not there.
    pub fn check_folder(&self) -> Result<()> {
        let Self { flag, path, .. } = self;
        let shown = path.display();
        match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
            Some(folder) => Err(Failure::usage(format!(
                "{flag} = {shown}: there is no folder {}; make it first",
                folder.display()
            ))),
            None => Ok(()),
        }
    }

    /// The same, and a file that is there and is not to be replaced.
    pub fn check_new(&self, overwrite: bool) -> Result<()> {
        self.check()?;
        if self.path.exists() && !overwrite {
            let message = "the file exists; choose another name, or --overwrite";
            return Err(Failure::usage(format!(
                "{} = {}: {message}",
                self.flag,
                self.path.display()
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(path: &Path) -> Output<'_> {
        Output { flag: "--output", path, kind: "a PNG", endings: &["png"] }
    }

    #[test]
    fn what_is_promised_is_what_is_written() {
        let folder = std::env::temp_dir();
        let refused =
            |name: &str| picture(&folder.join(name)).check().unwrap_err().words().to_owned();
        assert!(refused("bow.jpg").contains("a PNG is written; give it the ending .png"));
        assert!(refused("bow").contains(".png"));
        assert!(refused("nowhere-7f3a/bow.png").contains("there is no folder"));
        assert!(Output { endings: &[], ..picture(&folder) }.check().is_err());
        assert!(picture(&folder.join("bow.PNG")).check().is_ok());
        assert!(picture(Path::new("bow.png")).check().is_ok());
        assert!(Output { endings: &[], ..picture(&folder.join("bow.any")) }.check().is_ok());
    }

    #[test]
    fn what_is_there_stays() {
        let path = std::env::temp_dir().join(format!("gonio-there-{}.png", std::process::id()));
        assert!(picture(&path).check_new(false).is_ok());
        std::fs::write(&path, "").unwrap();
        assert!(picture(&path).check_new(false).unwrap_err().words().contains("--overwrite"));
        assert!(picture(&path).check_new(true).is_ok());
        std::fs::remove_file(path).unwrap();
    }
}
