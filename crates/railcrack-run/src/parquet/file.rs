//! A Parquet file: groups of rows, then what is in them.

use super::page::{ColumnKind, Values, ZSTD};
use super::thrift::Struct;
use crate::disk::VERSION;

const MAGIC: &[u8] = b"PAR1";
/// Rows of a group.
const GROUP: usize = 1 << 18;
/// A value may be missing.
const OPTIONAL: i32 = 1;
/// Text of a binary column.
const UTF8: i32 = 0;

/// A file under construction.
#[derive(Debug)]
pub(crate) struct ParquetFile {
    columns: Vec<(String, ColumnKind)>,
    /// Rows that no group has yet, by column.
    waiting: Vec<Values>,
    bytes: Vec<u8>,
    groups: Vec<Struct>,
    rows: usize,
}

impl ParquetFile {
    /// A file with these columns, at least one.
    pub(crate) fn new(columns: Vec<(String, ColumnKind)>) -> Self {
        let waiting = columns.iter().map(|(_, kind)| Values::none(*kind)).collect();
        Self { columns, waiting, bytes: MAGIC.to_vec(), groups: Vec::new(), rows: 0 }
    }

    /// Its columns.
    pub(crate) fn columns(&self) -> &[(String, ColumnKind)] {
        &self.columns
    }

    /// Appends a row: a field for each column, empty where there is no value.
    pub(crate) fn row<'a>(&mut self, fields: impl Iterator<Item = &'a str>) {
        self.waiting.iter_mut().zip(fields).for_each(|(values, field)| values.push(field));
        if self.waiting.first().is_some_and(|values| values.len() >= GROUP) {
            self.end_group();
        }
    }

    fn end_group(&mut self) {
        let rows = self.waiting.first().map_or(0, Values::len);
        if rows == 0 {
            return;
        }
        let (mut chunks, mut total) = (Vec::new(), 0);
        for ((name, kind), values) in self.columns.iter().zip(&mut self.waiting) {
            let (page, whole) = std::mem::replace(values, Values::none(*kind)).page();
            let offset = self.bytes.len() as i64;
            let column = Struct::default()
                .i32(1, kind.physical())
                .numbers(2, &kind.encodings())
                .texts(3, &[name])
                .i32(4, ZSTD)
                .i64(5, rows as i64)
                .i64(6, whole as i64)
                .i64(7, page.len() as i64)
                .i64(9, offset);
            chunks.push(Struct::default().i64(2, offset).nested(3, column));
            total += whole;
            self.bytes.extend(page);
        }
        self.groups.push(Struct::default().structs(1, chunks).i64(2, total as i64).i64(3, rows as i64));
        self.rows += rows;
    }

    /// The file.
    pub(crate) fn finish(mut self) -> Vec<u8> {
        self.end_group();
        let column = |(name, kind): &(String, ColumnKind)| {
            let element = Struct::default().i32(1, kind.physical()).i32(3, OPTIONAL).text(4, name);
            if *kind == ColumnKind::Text { element.i32(6, UTF8) } else { element }
        };
        let root = Struct::default().text(4, "table").i32(5, self.columns.len() as i32);
        let schema = std::iter::once(root).chain(self.columns.iter().map(column)).collect();
        let footer = Struct::default()
            .i32(1, 1)
            .structs(2, schema)
            .i64(3, self.rows as i64)
            .structs(4, self.groups)
            .text(6, &format!("railcrack {VERSION}"))
            .end();
        self.bytes.extend(&footer);
        self.bytes.extend((footer.len() as u32).to_le_bytes());
        self.bytes.extend(MAGIC);
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use std::process::{Command, Stdio};

    fn sample() -> Vec<u8> {
        let columns = [
            ("run", ColumnKind::Integer),
            ("contact.friction", ColumnKind::Number),
            ("crack[1].stop", ColumnKind::Text),
        ];
        let mut file = ParquetFile::new(columns.map(|(name, kind)| (name.to_owned(), kind)).to_vec());
        for i in 0..300_000 {
            let (run, friction) = (i.to_string(), format!("{:?}", 0.1 + f64::from(i).sin()));
            let word = if i % 3 == 0 { "" } else { "arrest, \u{e9}" };
            file.row([run.as_str(), if i % 7 == 0 { "" } else { &friction }, word].into_iter());
        }
        file.finish()
    }

    #[test]
    fn a_file_begins_and_ends_as_it_must_and_is_the_same_each_time() {
        let file = sample();
        assert!(file.starts_with(MAGIC) && file.ends_with(MAGIC));
        let length = u32::from_le_bytes(file[file.len() - 8..file.len() - 4].try_into().unwrap()) as usize;
        assert!(length < 2000, "{length} bytes of footer");
        assert_eq!(file, sample());
    }

    #[test]
    #[ignore = "extra: needs RAILCRACK_PYTHON, a Python with pyarrow; .ci/run provides it"]
    fn arrow_reads_every_value() {
        let python = std::env::var("RAILCRACK_PYTHON").expect("RAILCRACK_PYTHON");
        let script = "import sys, io, math, pyarrow.parquet as q\n\
            t = q.read_table(io.BytesIO(sys.stdin.buffer.read())).to_pydict()\n\
            assert t['run'] == list(range(300000)), 'run'\n\
            f = t['contact.friction']\n\
            assert all((v is None) == (i % 7 == 0) for i, v in enumerate(f)), 'missing'\n\
            assert all(v is None or abs(v - 0.1 - math.sin(i)) < 1e-15 for i, v in enumerate(f)), 'numbers'\n\
            assert t['crack[1].stop'] == [None if i % 3 == 0 else 'arrest, \u{e9}' for i in range(300000)], 'words'\n";
        let mut child = Command::new(python).args(["-c", script]).stdin(Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(&sample()).unwrap();
        assert!(child.wait().unwrap().success());
    }
}
