//! Connections, each with one request and one response.

use super::answer::Answer;
use super::request::Request;
use super::site::Site;
use std::io::{ErrorKind, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Interval at which waiting threads check for the end.
const LOOK: Duration = Duration::from_millis(50);
/// Timeout for reading a request and for writing a response.
const PATIENCE: Duration = Duration::from_secs(5);
/// Maximum length of a request header; browsers send some hundred bytes.
const LONGEST: usize = 16 * 1024;
/// Maximum number of simultaneous connections; a browser opens six.
const MOST: usize = 32;

/// Serves requests from `listener` until `end` is set and all threads have ended.
///
/// Errors: the system refuses to listen.
pub(super) fn serve(listener: &TcpListener, site: &Site, end: &AtomicBool) -> std::io::Result<()> {
    listener.set_nonblocking(true)?;
    let busy = AtomicUsize::new(0);
    std::thread::scope(|threads| {
        while !end.load(Ordering::Relaxed) {
            match listener.accept() {
                // More connections than a browser opens are closed.
                Ok(_) if busy.load(Ordering::Relaxed) >= MOST => {}
                Ok((stream, _)) => {
                    busy.fetch_add(1, Ordering::Relaxed);
                    let busy = &busy;
                    threads.spawn(move || {
                        // A client that has disconnected needs no response.
                        let _ = converse(stream, site, end);
                        busy.fetch_sub(1, Ordering::Relaxed);
                    });
                }
                // No client is waiting, or it has disconnected before being accepted.
                Err(_) => std::thread::sleep(LOOK),
            }
        }
    });
    Ok(())
}

/// Errors: the connection breaks.
fn converse(mut stream: TcpStream, site: &Site, end: &AtomicBool) -> std::io::Result<()> {
    // On some systems the stream inherits the non-blocking mode of its listener.
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(LOOK))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let Some(head) = head_of(&mut stream, end)? else { return Ok(()) };
    let (answer, with_body) = match Request::of(&head) {
        Ok(request) => (site.answer(&request), request.wants_body),
        Err(refusal) => (refusal, true),
    };
    write(&mut stream, &answer, with_body)
}

/// The request header up to its empty line; none if it does not arrive or is too long.
fn head_of(stream: &mut TcpStream, end: &AtomicBool) -> std::io::Result<Option<Vec<u8>>> {
    let (begun, mut head, mut part) = (Instant::now(), Vec::new(), [0; 2048]);
    while !end.load(Ordering::Relaxed) && begun.elapsed() < PATIENCE && head.len() < LONGEST {
        match stream.read(&mut part) {
            Ok(0) => return Ok(None),
            Ok(count) => head.extend_from_slice(&part[..count]),
            Err(reason) if matches!(reason.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => continue,
            Err(reason) if reason.kind() == ErrorKind::Interrupted => continue,
            Err(reason) => return Err(reason),
        }
        if head.windows(4).any(|end| end == b"\r\n\r\n") {
            return Ok(Some(head));
        }
    }
    Ok(None)
}

fn write(stream: &mut TcpStream, answer: &Answer, with_body: bool) -> std::io::Result<()> {
    stream.write_all(answer.head().as_bytes())?;
    if with_body {
        stream.write_all(&answer.body)?;
    }
    stream.flush()
}
