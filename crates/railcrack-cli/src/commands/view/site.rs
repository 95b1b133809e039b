//! Site of a folder: its live page and its files.

use super::answer::Answer;
use super::live::WatchedFolder;
use super::request::Request;
use railcrack_run::files::REPORT_FILE;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

/// Maximum number of pages in memory; a study has one for each of up to thousands of runs.
const MOST_PAGES: usize = 16;
/// Path under which a page polls for progress.
const STATE: &str = "state";

/// A folder and its pages.
#[derive(Debug)]
pub(super) struct Site {
    /// Canonical path, without symbolic links.
    root: PathBuf,
    /// The pages that were asked for last, with their folders, the last one at the end; the runs of
    /// a study have their own pages.
    pages: Mutex<Vec<(PathBuf, Arc<WatchedFolder>)>>,
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

    fn page(&self, folder: PathBuf) -> Arc<WatchedFolder> {
        let mut pages = self.pages.lock().unwrap_or_else(PoisonError::into_inner);
        let known = pages.iter().position(|(known, _)| *known == folder).map(|at| pages.remove(at));
        let (folder, page) = known.unwrap_or_else(|| (folder.clone(), Arc::new(WatchedFolder::of(folder))));
        if pages.len() >= MOST_PAGES {
            pages.remove(0);
        }
        pages.push((folder, Arc::clone(&page)));
        page
    }

    fn file(&self, folders: &[String], file: &str) -> Answer {
        let names: Vec<&str> = folders.iter().map(String::as_str).chain([file]).collect();
        let file = self.inside(&names).and_then(|path| Answer::file(&path).ok());
        file.unwrap_or_else(Answer::not_found)
    }
}
