//! Connections, each with one request and one response.

use super::answer::{Answer, Body};
use super::request::Request;
use super::site::Site;
use std::io::{ErrorKind, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Weak};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Interval at which waiting threads check for the end.
const LOOK: Duration = Duration::from_millis(50);
/// Timeout for reading a request, and for a response in addition to the time for its bytes.
const PATIENCE: Duration = Duration::from_secs(5);
/// Least average speed of a client, bytes per second; a browser on the same machine reads a
/// thousand times as fast.
const SLOWEST: f64 = 262_144.0;
/// Bytes sent at a time.
const CHUNK: usize = 1 << 16;
/// Maximum length of a request header; browsers send some hundred bytes.
const LONGEST: usize = 16 * 1024;
/// Maximum number of simultaneous connections; a browser opens six.
const MOST: usize = 32;
/// Time for connections to end with the program.
const GRACE: Duration = Duration::from_millis(500);

/// A connection.
struct Client {
    thread: JoinHandle<()>,
    /// Closed with the end of the thread, to which it belongs.
    stream: Weak<TcpStream>,
    /// Whether it was closed to make room for others.
    is_closed: bool,
}

/// Serves requests from `listener` until `end` is set. Of more connections than a browser opens,
/// the oldest one is closed, so that clients that do not read cannot keep others from their
/// responses. A page that is being made for a connection at the end is abandoned with the program,
/// which writes nothing.
///
/// Errors: the system refuses to listen.
pub(super) fn serve(listener: &TcpListener, site: &Arc<Site>, end: &Arc<AtomicBool>) -> std::io::Result<()> {
    listener.set_nonblocking(true)?;
    let mut clients: Vec<Client> = Vec::new();
    while !end.load(Ordering::Relaxed) {
        match listener.accept() {
            Ok((stream, _)) => {
                clients.retain(|client| !client.thread.is_finished());
                make_room(&mut clients);
                // A client for which there is no room is closed.
                if clients.len() < 2 * MOST {
                    let (site, end, stream) = (Arc::clone(site), Arc::clone(end), Arc::new(stream));
                    let handle = Arc::downgrade(&stream);
                    // A client that has disconnected needs no response.
                    let thread = std::thread::spawn(move || drop(converse(&stream, &site, &end)));
                    clients.push(Client { thread, stream: handle, is_closed: false });
                }
            }
            // No client is waiting, or it has disconnected before being accepted.
            Err(_) => std::thread::sleep(LOOK),
        }
    }
    let begun = Instant::now();
    while begun.elapsed() < GRACE && clients.iter().any(|client| !client.thread.is_finished()) {
        std::thread::sleep(LOOK / 5);
    }
    Ok(())
}

/// Closes the oldest connection if there are as many as allowed.
fn make_room(clients: &mut [Client]) {
    if clients.iter().filter(|client| !client.is_closed).count() < MOST {
        return;
    }
    if let Some(oldest) = clients.iter_mut().find(|client| !client.is_closed) {
        if let Some(stream) = oldest.stream.upgrade() {
            // The client may have closed it already.
            let _ = stream.shutdown(Shutdown::Both);
        }
        oldest.is_closed = true;
    }
}

/// Errors: the connection breaks; the client is too slow; the program ends.
fn converse(stream: &TcpStream, site: &Site, end: &AtomicBool) -> std::io::Result<()> {
    // On some systems the stream inherits the non-blocking mode of its listener.
    stream.set_nonblocking(false)?;
    stream.set_read_timeout(Some(LOOK))?;
    stream.set_write_timeout(Some(LOOK))?;
    let Some(head) = head_of(stream, end)? else { return Ok(()) };
    let (answer, with_body) = match Request::of(&head) {
        Ok(request) => (site.answer(&request), request.wants_body),
        Err(refusal) => (refusal, true),
    };
    Response { stream, end, begun: Instant::now(), sent: 0 }.send(answer, with_body)
}

/// The request header up to its empty line; none if it does not arrive or is too long.
fn head_of(mut stream: &TcpStream, end: &AtomicBool) -> std::io::Result<Option<Vec<u8>>> {
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

/// A response on its way.
struct Response<'a> {
    stream: &'a TcpStream,
    end: &'a AtomicBool,
    begun: Instant,
    /// Bytes sent so far.
    sent: usize,
}

impl Response<'_> {
    fn send(mut self, answer: Answer, with_body: bool) -> std::io::Result<()> {
        self.write(answer.head().as_bytes())?;
        if !with_body {
            return Ok(());
        }
        match answer.body {
            Body::Bytes(bytes) => self.write(&bytes),
            Body::File(mut file, mut left) => {
                let mut chunk = vec![0; CHUNK];
                while left > 0 {
                    let most = usize::try_from(left).unwrap_or(CHUNK).min(CHUNK);
                    let count = file.read(&mut chunk[..most])?;
                    if count == 0 {
                        // The file has become shorter: the response ends early, which is visible.
                        break;
                    }
                    self.write(&chunk[..count])?;
                    left -= count as u64;
                }
                Ok(())
            }
        }
    }

    /// Writes all of `bytes`, as long as the client reads fast enough.
    fn write(&mut self, mut bytes: &[u8]) -> std::io::Result<()> {
        while !bytes.is_empty() {
            let allowed = PATIENCE + Duration::from_secs_f64(self.sent as f64 / SLOWEST);
            if self.end.load(Ordering::Relaxed) || self.begun.elapsed() > allowed {
                return Err(ErrorKind::TimedOut.into());
            }
            match self.stream.write(bytes) {
                Ok(0) => return Err(ErrorKind::WriteZero.into()),
                Ok(count) => {
                    bytes = &bytes[count..];
                    self.sent += count;
                }
                Err(reason)
                    if matches!(
                        reason.kind(),
                        ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted
                    ) => {}
                Err(reason) => return Err(reason),
            }
        }
        Ok(())
    }
}
