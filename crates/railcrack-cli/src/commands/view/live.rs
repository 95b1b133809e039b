//! Live page of a folder of results.

use super::answer::Answer;
use railcrack_report::{LivePage, Page, live_page};
use railcrack_run::OutputError;
use railcrack_run::files::REPORT_FILE;
use serde_json::json;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The script that polls for new results.
const SCRIPT: &str = include_str!("live.js");
/// Shortest time between two reads of the results, and the same as a multiple of the time that a
/// read takes, so that the viewer does not slow down the computation.
const REST: Duration = Duration::from_millis(500);
const SHARE: u32 = 8;

/// The page of a folder, refreshed on request.
#[derive(Debug)]
pub(super) struct WatchedFolder {
    folder: PathBuf,
    last: Mutex<Option<Reading>>,
}

/// A snapshot of the page.
#[derive(Debug, Clone)]
struct Reading {
    page: Arc<LivePage>,
    /// The page with the polling script.
    html: Arc<[u8]>,
    /// Number of the page, different for each version.
    stamp: String,
    at: Instant,
    took: Duration,
}

fn with_script(html: &str, stamp: &str) -> Arc<[u8]> {
    let script = format!("<script data-stamp=\"{stamp}\">\n{SCRIPT}</script>\n</body>");
    let (before, after) = html.rsplit_once("</body>").unwrap_or((html, ""));
    [before, &script, after].concat().into_bytes().into()
}

impl WatchedFolder {
    pub(super) fn of(folder: PathBuf) -> Self {
        Self { folder, last: Mutex::new(None) }
    }

    /// The page with the polling script.
    pub(super) fn answer(&self) -> Answer {
        Answer::page(self.reading().html)
    }

    /// Progress of the results.
    pub(super) fn state(&self) -> Answer {
        let Reading { page, stamp, .. } = self.reading();
        Answer::json(&json!({ "stamp": stamp, "progress": page.progress, "over": page.is_over }))
    }

    /// The current results, or a recent snapshot.
    fn reading(&self) -> Reading {
        let mut last = self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let is_fresh = |reading: &&Reading| {
            reading.page.is_over || reading.at.elapsed() < REST.max(SHARE * reading.took)
        };
        if let Some(reading) = last.as_ref().filter(is_fresh) {
            return reading.clone();
        }
        let begun = Instant::now();
        let page = match (live_page(&self.folder), &*last) {
            (Ok(page), _) => Arc::new(page),
            // A file that is being written is complete at the next read.
            (Err(_), Some(before)) => Arc::clone(&before.page),
            (Err(error), None) => Arc::new(self.stand_in(&error)),
        };
        let mut hasher = DefaultHasher::new();
        (&page.html, page.is_over).hash(&mut hasher);
        let stamp = format!("{:016x}", hasher.finish());
        let html = with_script(&page.html, &stamp);
        let reading = Reading { page, html, stamp, at: Instant::now(), took: begun.elapsed() };
        *last = Some(reading.clone());
        reading
    }

    /// The page shown before results can be read: an existing `report.html`, or the reason.
    fn stand_in(&self, error: &OutputError) -> LivePage {
        if let Ok(html) = std::fs::read_to_string(self.folder.join(REPORT_FILE)) {
            return LivePage { html, progress: "as stored in report.html".to_owned(), is_over: false };
        }
        let is_empty = matches!(error, OutputError::NothingToReport { .. });
        let (verdict, progress) = match is_empty {
            true => ("No step is finished yet.".to_owned(), "waiting for the first results".to_owned()),
            false => (format!("The results cannot be shown: {error}."), "waiting".to_owned()),
        };
        let page = Page {
            title: self.folder.display().to_string(),
            kind: "Results pending".to_owned(),
            verdict,
            ..Page::default()
        };
        LivePage { html: page.html(), progress, is_over: false }
    }
}
