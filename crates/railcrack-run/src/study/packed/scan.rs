//! The records of a file, and the bytes between them that are none.

use super::record::{FORMAT, HEADER, Header, MARK, other_format};
use crate::disk::{Checksum, VERSION};
use crate::error::OutputError;
use std::fs::File;
use std::io::{BufReader, Read, Result, Seek, SeekFrom};
use std::path::Path;

/// Bytes that are searched at a time for the next record.
const WINDOW: usize = 1 << 18;

/// A whole record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Record {
    pub header: Header,
    /// Offset of its body.
    pub body: u64,
}

/// Bytes that hold no record, and are not the beginning of one that a kill has cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Damage {
    pub from: u64,
    pub to: u64,
    /// The run whose record they held, where its header is whole.
    pub run: Option<u64>,
}

/// Content of a file.
#[derive(Debug, Default)]
pub(super) struct Scan {
    pub records: Vec<Record>,
    pub damages: Vec<Damage>,
    /// Where the next record goes: behind all bytes, except the beginning of a record that a kill
    /// has cut.
    pub end: u64,
}

/// The beginning of something at an offset.
enum Beginning {
    Record(Record, u64),
    /// A whole header, and a body that is not.
    Broken(Header),
    /// The beginning of a record, with which the file ends; its header, where that is whole.
    Cut(Option<Header>),
    Nothing,
}

impl Scan {
    /// Reads the file `path`.
    ///
    /// Errors: it has another format; the system refuses.
    pub(super) fn of(path: &Path) -> std::result::Result<Self, OutputError> {
        let refused = || OutputError::io("read", path);
        let file = File::open(path).map_err(refused())?;
        let length = file.metadata().map_err(refused())?.len();
        let mut reader = Reader { file: BufReader::with_capacity(WINDOW, file), at: 0, length };
        let scan = Self::read(&mut reader).map_err(refused())?;
        if scan.damages.first().is_some_and(|damage| damage.from == 0)
            && let Some(format) = reader.first_format().map_err(refused())?
        {
            return Err(OutputError::OtherVersion {
                folder: path.to_path_buf(),
                written_by: format!("with packed format {format}"),
                this: format!("{VERSION} with packed format {FORMAT}"),
            });
        }
        Ok(scan)
    }

    fn read(reader: &mut Reader) -> Result<Self> {
        let mut scan = Self::default();
        let mut at = 0;
        while at < reader.length {
            let (run, is_cut) = match reader.beginning(at)? {
                Beginning::Record(record, end) => {
                    scan.records.push(record);
                    at = end;
                    continue;
                }
                Beginning::Broken(header) => (Some(header.number), false),
                Beginning::Cut(header) => (header.map(|header| header.number), true),
                Beginning::Nothing => (None, false),
            };
            let next = reader.next_header(at + 1)?;
            if next.is_none() && is_cut {
                break;
            }
            let to = next.unwrap_or(reader.length);
            scan.damages.push(Damage { from: at, to, run });
            at = to;
        }
        scan.end = at;
        Ok(scan)
    }
}

/// A file read at any offset.
struct Reader {
    file: BufReader<File>,
    /// Where it is read next.
    at: u64,
    length: u64,
}

impl Reader {
    /// Up to `most` bytes from the offset `from` on.
    fn bytes(&mut self, from: u64, most: usize) -> Result<Vec<u8>> {
        if from != self.at {
            self.file.seek(SeekFrom::Start(from))?;
        }
        let mut bytes = Vec::new();
        let read = self.file.by_ref().take(most as u64).read_to_end(&mut bytes);
        self.at = from + bytes.len() as u64;
        read.map(|_| bytes)
    }

    fn beginning(&mut self, at: u64) -> Result<Beginning> {
        let bytes = self.bytes(at, HEADER)?;
        let Some(header) = Header::of(&bytes) else {
            let mark = [&MARK[..], &[FORMAT]].concat();
            let own = bytes.len().min(mark.len());
            let is_cut = bytes.len() < HEADER && bytes[..own] == mark[..own];
            return Ok(if is_cut { Beginning::Cut(None) } else { Beginning::Nothing });
        };
        let body = at + HEADER as u64;
        let Some(end) = body.checked_add(header.length).filter(|&end| end <= self.length) else {
            return Ok(Beginning::Cut(Some(header)));
        };
        // The length is that of bytes in the file: no more is asked for.
        let content = self.bytes(body, header.length as usize)?;
        let is_whole = content.len() as u64 == header.length && Checksum::of(&content) == header.body;
        Ok(if is_whole { Beginning::Record(Record { header, body }, end) } else { Beginning::Broken(header) })
    }

    /// The offset of the next whole header from `from` on.
    fn next_header(&mut self, mut from: u64) -> Result<Option<u64>> {
        while from + HEADER as u64 <= self.length {
            let window = self.bytes(from, WINDOW)?;
            let found = window.windows(HEADER).position(|bytes| Header::of(bytes).is_some());
            if let Some(place) = found {
                return Ok(Some(from + place as u64));
            }
            if window.len() < HEADER {
                break;
            }
            // A header may lie across the end of the window.
            from += (window.len() - HEADER + 1) as u64;
        }
        Ok(None)
    }

    /// The format of the file, where it is another one.
    fn first_format(&mut self) -> Result<Option<u64>> {
        Ok(other_format(&self.bytes(0, HEADER)?))
    }
}
