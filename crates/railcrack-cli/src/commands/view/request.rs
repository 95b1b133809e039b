//! HTTP requests.

use super::answer::Answer;

/// Maximum number of headers; a browser sends about twenty.
const HEADERS: usize = 64;

/// A request for a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Request {
    /// Path components from the folder to the file; empty for the folder itself. None leads out of
    /// it.
    pub(super) names: Vec<String>,
    /// Whether the path ends in `/`.
    pub(super) is_folder: bool,
    /// Whether the body is requested too.
    pub(super) wants_body: bool,
}

impl Request {
    /// Parses the request header `head`.
    ///
    /// Errors: the response to an invalid request.
    pub(super) fn of(head: &[u8]) -> Result<Self, Answer> {
        let bad = || Answer::refused("400 Bad Request", "invalid request");
        let mut headers = [httparse::EMPTY_HEADER; HEADERS];
        let mut request = httparse::Request::new(&mut headers);
        match request.parse(head) {
            Ok(httparse::Status::Complete(_)) => {}
            _ => return Err(bad()),
        }
        let wants_body = match request.method {
            Some("GET") => true,
            Some("HEAD") => false,
            _ => return Err(Answer::refused("405 Method Not Allowed", "only GET and HEAD are supported")),
        };
        let host = request.headers.iter().find(|header| header.name.eq_ignore_ascii_case("host"));
        if !host.is_some_and(|host| is_local(host.value)) {
            // Guards against DNS rebinding.
            return Err(Answer::refused("403 Forbidden", "the host must be 127.0.0.1 or localhost"));
        }
        let path = request.path.ok_or_else(bad)?;
        let path = path.split(['?', '#']).next().unwrap_or_default();
        let path = path.strip_prefix('/').ok_or_else(bad)?;
        let names: Option<Vec<String>> =
            path.split('/').filter(|name| !name.is_empty()).map(decoded).collect();
        let names = names.ok_or_else(bad)?;
        if names.iter().any(|name| name == ".." || name == "." || name.contains(['/', '\\', ':', '\0'])) {
            return Err(Answer::not_found());
        }
        Ok(Self { names, is_folder: path.is_empty() || path.ends_with('/'), wants_body })
    }
}

/// Reads `head`: no name of a request leads out of its folder.
#[cfg(fuzzing)]
pub fn fuzz_request(head: &[u8]) {
    if let Ok(request) = Request::of(head) {
        let leaves =
            |name: &String| matches!(&name[..], "" | "." | "..") || name.contains(['/', '\\', ':', '\0']);
        assert!(!request.names.iter().any(leaves), "{:?}", request.names);
    }
}

/// Whether `host` is the local machine, with or without a port.
fn is_local(host: &[u8]) -> bool {
    let Ok(host) = std::str::from_utf8(host) else { return false };
    let name = match host.rsplit_once(':') {
        Some((name, port)) if port.bytes().all(|digit| digit.is_ascii_digit()) => name,
        _ => host,
    };
    name == "127.0.0.1" || name.eq_ignore_ascii_case("localhost")
}

/// `name` with percent-encoded bytes decoded; none if the result is not UTF-8.
fn decoded(name: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(name.len());
    let mut rest = name.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        if first == b'%' {
            let digits = std::str::from_utf8(after.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(digits, 16).ok()?);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(path: &str) -> Option<Vec<String>> {
        let head = format!("GET {path} HTTP/1.1\r\nHost: 127.0.0.1:4000\r\n\r\n");
        Request::of(head.as_bytes()).ok().map(|request| request.names)
    }

    #[test]
    fn paths_are_names_that_stay_in_the_folder() {
        assert_eq!(names("/").unwrap(), [""; 0]);
        assert_eq!(names("/plots/a%20b.svg?x=1").unwrap(), ["plots", "a b.svg"]);
        for path in ["/../x", "/%2e%2e/x", "/a/..%2fb", "/a%5cb", "/c%3a", "/a%00", "/%ff", "/%4", "x"] {
            assert_eq!(names(path), None, "{path}");
        }
    }

    #[test]
    fn only_this_machine_is_answered() {
        let of = |line: &str| Request::of(format!("GET / HTTP/1.1\r\n{line}\r\n\r\n").as_bytes()).is_ok();
        assert!(of("Host: localhost:80") && of("host: 127.0.0.1"));
        assert!(!of("Host: example.org") && !of("Host: 127.0.0.1.example.org:80") && !of("Accept: x"));
        assert!(Request::of(b"POST / HTTP/1.1\r\nHost: localhost\r\n\r\n").is_err());
        assert!(Request::of(b"nonsense\r\n\r\n").is_err());
    }
}
