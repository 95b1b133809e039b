//! HTTP responses.

use std::path::Path;

/// Response to a request: status, media type, content.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    status: &'static str,
    media: &'static str,
    pub(super) body: Vec<u8>,
}

const TEXT: &str = "text/plain; charset=utf-8";

impl Answer {
    pub(super) fn page(html: String) -> Self {
        Self { status: "200 OK", media: "text/html; charset=utf-8", body: html.into_bytes() }
    }

    pub(super) fn json(value: &serde_json::Value) -> Self {
        Self { status: "200 OK", media: "application/json", body: value.to_string().into_bytes() }
    }

    /// The content of the file at `path`.
    pub(super) fn file(path: &Path, body: Vec<u8>) -> Self {
        let media = match path.extension().and_then(|ending| ending.to_str()) {
            Some("html") => "text/html; charset=utf-8",
            Some("svg") => "image/svg+xml",
            Some("png") => "image/png",
            Some("json") => "application/json",
            Some("csv" | "toml" | "txt") => TEXT,
            _ => "application/octet-stream",
        };
        Self { status: "200 OK", media, body }
    }

    pub(super) fn refused(status: &'static str, why: &str) -> Self {
        Self { status, media: TEXT, body: format!("{why}\n").into_bytes() }
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
            body.len()
        )
    }
}
