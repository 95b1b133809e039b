//! Tables as Parquet files (Apache Parquet 2.9): what pandas, Polars, DuckDB and Arrow read in one
//! line. Written only: one data page for each column of a group of rows, compressed by zstd, with
//! its checksum; the footer has that of the file.

mod file;
mod page;
mod thrift;

pub(crate) use file::{ParquetFile, check};
pub(crate) use page::ColumnKind;
