//! Site of a folder: its live page and its files.

use super::answer::Answer;
use super::live::LivePage;
use super::request::Request;
use railcrack_run::files::REPORT_FILE;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Path under which a page polls for progress.
const STATE: &str = "state";

/// A folder and its pages.
#[derive(Debug)]
pub(super) struct Site {
    /// Canonical path, without symbolic links.
    root: PathBuf,
    /// Pages by folder; the runs of a study have their own pages.
    pages: Mutex<BTreeMap<PathBuf, Arc<LivePage>>>,
}

impl Site {
    /// Errors: there is no such folder.
    pub(super) fn of(folder: &Path) -> std::io::Result<Self> {
        let root = folder.canonicalize()?;
        if !root.is_dir() {
            return Err(std::io::ErrorKind::NotADirectory.into());
        }
        Ok(Self { root, pages: Mutex::default() })
    }

    /// The response to `request`.
    pub(super) fn answer(&self, request: &Request) -> Answer {
        let (last, folders) = match request.names.split_last() {
            Some((last, folders)) if !request.is_folder => (last.as_str(), folders),
            _ => (REPORT_FILE, &request.names[..]),
        };
        let Some(folder) = self.inside(folders).filter(|folder| folder.is_dir()) else {
            return Answer::not_found();
        };
        match last {
            REPORT_FILE => self.page(folder).answer(),
            STATE => self.page(folder).state(),
            file => self.file(folders, file),
        }
    }

    /// The path of `names`; none if it does not exist, or if a link leads out of the folder.
    fn inside<T: AsRef<Path>>(&self, names: &[T]) -> Option<PathBuf> {
        let path = names.iter().fold(self.root.clone(), |path, name| path.join(name));
        path.canonicalize().ok().filter(|path| path.starts_with(&self.root))
    }

    fn page(&self, folder: PathBuf) -> Arc<LivePage> {
        let mut pages = self.pages.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(pages.entry(folder.clone()).or_insert_with(|| Arc::new(LivePage::of(folder))))
    }

    fn file(&self, folders: &[String], file: &str) -> Answer {
        let names: Vec<&str> = folders.iter().map(String::as_str).chain([file]).collect();
        match self.inside(&names).filter(|path| path.is_file()).map(|path| (std::fs::read(&path), path)) {
            Some((Ok(content), path)) => Answer::file(&path, content),
            _ => Answer::not_found(),
        }
    }
}
