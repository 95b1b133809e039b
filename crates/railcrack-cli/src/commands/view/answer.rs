//! HTTP responses.

use railcrack_case::open_regular;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// Response to a request: status, media type, content.
#[derive(Debug)]
pub(super) struct Answer {
    status: &'static str,
    media: &'static str,
    pub(super) body: Body,
}

/// Content of a response: shared by all clients that are sent it, or still on the disk.
#[derive(Debug)]
pub(super) enum Body {
    Bytes(Arc<[u8]>),
    /// A file and the number of its bytes that are sent.
    File(File, u64),
}

impl Body {
    fn length(&self) -> u64 {
        match self {
            Self::Bytes(bytes) => bytes.len() as u64,
            Self::File(_, length) => *length,
        }
    }
}

fn text(text: String) -> Body {
    Body::Bytes(text.into_bytes().into())
}

const TEXT: &str = "text/plain; charset=utf-8";

impl Answer {
    pub(super) fn page(html: Arc<[u8]>) -> Self {
        Self { status: "200 OK", media: "text/html; charset=utf-8", body: Body::Bytes(html) }
    }

    pub(super) fn json(value: &serde_json::Value) -> Self {
        Self { status: "200 OK", media: "application/json", body: text(value.to_string()) }
    }

    /// The content of the regular file at `path`.
    ///
    /// Errors: the system refuses.
    pub(super) fn file(path: &Path) -> std::io::Result<Self> {
        let file = open_regular(path)?;
        let length = file.metadata()?.len();
        let media = match path.extension().and_then(|ending| ending.to_str()) {
            Some("html") => "text/html; charset=utf-8",
            Some("svg") => "image/svg+xml",
            Some("png") => "image/png",
            Some("json") => "application/json",
            Some("csv" | "toml" | "txt") => TEXT,
            _ => "application/octet-stream",
        };
        Ok(Self { status: "200 OK", media, body: Body::File(file, length) })
    }

    pub(super) fn refused(status: &'static str, why: &str) -> Self {
        Self { status, media: TEXT, body: text(format!("{why}\n")) }
    }

    pub(super) fn not_found() -> Self {
        Self::refused("404 Not Found", "no such file in the folder")
    }

    /// Header of the response. Caching is disabled because results change, and other sites may not
    /// embed them.
    pub(super) fn head(&self) -> String {
        let Self { status, media, body } = self;
        format!(
            "HTTP/1.1 {status}\r\nContent-Type: {media}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n\
             X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\n\
             Connection: close\r\n\r\n",
            body.length()
        )
    }
}
