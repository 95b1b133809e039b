//! `railcrack view` as a browser meets it.

use super::common::{self, command, folder, railcrack, stderr};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

/// The program while it serves.
struct Viewer {
    child: Child,
    address: String,
}

impl Viewer {
    fn of(place: &Path, folder: &str) -> Self {
        let mut child = command(place, &["view", folder]).stdout(Stdio::piped()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address =
            line.split("http://").nth(1).and_then(|rest| rest.split('/').next()).unwrap().to_owned();
        assert!(address.starts_with("127.0.0.1:"), "{line}");
        Self { child, address }
    }

    /// The answer to a request of these lines: its status, and what follows the head.
    fn asked(&self, lines: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream.write_all(format!("{lines}\r\nConnection: close\r\n\r\n").as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        (head.split(' ').nth(1).unwrap().parse().unwrap(), body.to_owned())
    }

    fn get(&self, path: &str) -> (u16, String) {
        self.asked(&format!("GET {path} HTTP/1.1\r\nHost: {}", self.address))
    }

    /// The state of `folder`, when it contains `words`.
    fn until(&self, folder: &str, words: &str) -> String {
        let begun = Instant::now();
        loop {
            let (code, state) = self.get(&format!("{folder}state"));
            assert_eq!(code, 200, "{state}");
            if state.contains(words) {
                return state;
            }
            assert!(begun.elapsed() < Duration::from_secs(60), "{state}");
            std::thread::sleep(Duration::from_millis(100));
        }
    }
}

/// Nothing is left behind where a test fails.
impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn a_page_follows_its_run() {
    let place = folder("view", "run");
    std::fs::write(place.join("case.toml"), common::DISLOCATION_CASE.as_str()).unwrap();
    std::fs::create_dir(place.join("run")).unwrap();
    let viewer = Viewer::of(&place, "run");
    let (code, page) = viewer.get("/");
    assert!(code == 200 && page.contains("No step is finished yet."), "{code}");
    assert!(viewer.get("/state").1.contains("waiting for the first results"));

    common::done(&place, &["run", "case.toml", "--out", "run", "--quiet"]);
    let state = viewer.until("/", "ended at step 2: steps done");
    assert!(state.contains("\"over\":true"), "{state}");
    // The page is that of the folder, and a script that follows.
    let (_, page) = viewer.get("/");
    let report = std::fs::read_to_string(place.join("run/report.html")).unwrap();
    let (before, _) = report.rsplit_once("</body>").unwrap();
    assert!(page.starts_with(before) && page.contains("data-stamp"), "another page");
    let table = std::fs::read_to_string(place.join("run/growth.csv")).unwrap();
    assert_eq!(viewer.get("/growth.csv"), (200, table));
    assert_eq!(viewer.get("/plots/ki.svg").0, 200);
}

#[test]
fn a_page_follows_its_study() {
    let place = folder("view", "study");
    let study = common::DISLOCATION_CASE.replace("angle_deg = 40.0", "angle_deg = [30.0, 40.0]");
    // By itself a study leaves out what the pages of its runs show.
    let study = format!("{study}\n[output]\nfaces = \"all\"\nsif = \"all\"\n");
    std::fs::write(place.join("study.toml"), study).unwrap();
    common::done(&place, &["sweep", "study.toml", "--out", "study", "--quiet"]);
    let viewer = Viewer::of(&place, "study");
    let state = viewer.until("/", "2 of 2 runs finished");
    assert!(state.contains("\"over\":true"), "{state}");
    assert!(viewer.get("/").1.contains("All runs"));
    // Runs have pages of their own.
    let run = std::fs::read_dir(place.join("study/runs")).unwrap().next().unwrap().unwrap().file_name();
    let run = format!("/runs/{}/", run.to_string_lossy());
    let (code, page) = viewer.get(&format!("{run}report.html"));
    assert!(code == 200 && page.contains("Passage of the wheel"), "{code}");
    viewer.until(&run, "ended at step 2");
}

#[test]
fn nothing_but_the_folder_is_served_and_to_nobody_else() {
    let place = folder("view", "closed");
    std::fs::create_dir_all(place.join("run/plots")).unwrap();
    std::fs::write(place.join("secret.txt"), "secret").unwrap();
    std::fs::write(place.join("run/note.txt"), "note").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(place.join("secret.txt"), place.join("run/link.txt")).unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink(&place, place.join("run/out")).unwrap();
    let viewer = Viewer::of(&place, "run");
    assert_eq!(viewer.get("/note.txt"), (200, "note".to_owned()));
    for path in [
        "/../secret.txt",
        "/plots/../../secret.txt",
        "/%2e%2e/secret.txt",
        "/..%2fsecret.txt",
        "/link.txt",
        "/out/secret.txt",
        "//etc/passwd",
        "/none.txt",
        "/plots",
    ] {
        let (code, body) = viewer.get(path);
        assert!(code == 404 && !body.contains("secret"), "{path}: {code} {body}");
    }
    assert_eq!(viewer.asked("GET / HTTP/1.1\r\nHost: example.org").0, 403);
    assert_eq!(viewer.asked("POST / HTTP/1.1\r\nHost: localhost").0, 405);
    assert_eq!(viewer.asked("nonsense").0, 400);
    assert_eq!(viewer.asked("HEAD /note.txt HTTP/1.1\r\nHost: localhost"), (200, String::new()));

    let refused = railcrack(&place, &["view", "none"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(stderr(&refused).contains("none: there is no such folder"), "{}", stderr(&refused));
    let port = viewer.address.rsplit(':').next().unwrap();
    let refused = railcrack(&place, &["view", "run", "--port", port]);
    assert_eq!(refused.status.code(), Some(4));
    assert!(stderr(&refused).contains(&format!("port {port} of 127.0.0.1")), "{}", stderr(&refused));
}

#[cfg(unix)]
#[test]
fn a_signal_ends_it_at_once() {
    let place = folder("view", "signal");
    std::fs::create_dir(place.join("run")).unwrap();
    let mut viewer = Viewer::of(&place, "run");
    // A connection that says nothing does not keep it.
    let _silent = TcpStream::connect(&viewer.address).unwrap();
    let id = viewer.child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = viewer.child.try_wait().unwrap() {
            break status;
        }
        assert!(begun.elapsed() < Duration::from_secs(4), "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    assert_eq!(status.code(), Some(0));
    assert!(TcpStream::connect(&viewer.address).is_err(), "somebody still listens");
}

/// Clients that take a few bytes now and then keep neither others from their pages nor the program
/// from its end, and what they are sent is not in memory.
#[cfg(target_os = "linux")]
#[test]
fn slow_readers_keep_nobody_waiting() {
    const CLIENTS: usize = 40;
    const LARGE: usize = 40 << 20;
    let place = folder("view", "slow");
    std::fs::create_dir(place.join("run")).unwrap();
    std::fs::write(place.join("run/large.bin"), vec![0; LARGE]).unwrap();
    std::fs::write(place.join("run/note.txt"), "note").unwrap();
    let mut viewer = Viewer::of(&place, "run");
    let request = b"GET /large.bin HTTP/1.1\r\nHost: localhost\r\n\r\n";
    let mut slow: Vec<TcpStream> = (0..CLIENTS)
        .map(|_| {
            let mut stream = TcpStream::connect(&viewer.address).unwrap();
            stream.write_all(request).unwrap();
            stream.set_nonblocking(true).unwrap();
            stream
        })
        .collect();
    let mut take = || {
        let mut few = [0; 512];
        // Some have been closed for others.
        slow.iter_mut().for_each(|stream| drop(stream.read(&mut few)));
    };
    for _ in 0..10 {
        take();
        std::thread::sleep(Duration::from_millis(50));
    }
    let begun = Instant::now();
    assert_eq!(viewer.get("/note.txt"), (200, "note".to_owned()));
    assert!(begun.elapsed() < Duration::from_secs(2), "{:?}", begun.elapsed());
    let status = std::fs::read_to_string(format!("/proc/{}/status", viewer.child.id())).unwrap();
    let memory = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap();
    let kilobytes: usize = memory.trim().trim_end_matches(" kB").parse().unwrap();
    assert!(kilobytes < 100_000, "{kilobytes} kB");
    let id = viewer.child.id().to_string();
    assert!(std::process::Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = viewer.child.try_wait().unwrap() {
            break status;
        }
        take();
        assert!(begun.elapsed() < Duration::from_secs(4), "it goes on");
        std::thread::sleep(Duration::from_millis(20));
    };
    assert_eq!(status.code(), Some(0));
}
